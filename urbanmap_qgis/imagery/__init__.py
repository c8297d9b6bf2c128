"""Line images and frames put to use: facades textured, outlines drawn on images brought into the map (Z 4.2)."""
