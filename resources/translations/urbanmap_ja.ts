<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="ja" sourcelanguage="en">
<context>
    <name>UrbanMap</name>
    <message>
        <source>Seed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A whole number; every one gives another city.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Size</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side of the square city in metres, 60 to 600. Time and disk space grow with its square.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scene</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A high-rise street canyon; one with few road markings; one whose markings were repainted between the flights and the drives; one under an elevated road. (canyon, few markings, repainted, elevated road)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Faults</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Faults of real surveys to put in, with commas between them: steps (in the trajectories), stops (a long wait), ghosts (points below the road), rings (lasers that differ), ground (heights of the airborne points that are off), rails (and decks), driveways (lowered kerbs), paint (worn and patched), surface (wet and concrete stretches). Without any the city is as ever.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Workers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of sensors that measure at the same time. The result does not depend on it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sample city</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A new or empty folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ALS points, unclassified</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ALS points, classified</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Official outlines</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exterior orientation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Conventional orthophoto</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mobile survey 1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Trajectory of survey 1, as reported</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mobile survey 2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Trajectory of survey 2, as reported</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibration of the mobile survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Aerial frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GNSS observations</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line scans and line images</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Truth</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of buildings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of airborne laser points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ALS points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of points of both mobile surveys.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MMS points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Orthophotos</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Two or more rasters of the same ground, grey or red, green, blue, of 8 or 16 bit. The result lies on the first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Vehicle filter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Majority vote: what most of them agree on, which also keeps dark vehicles from winning over paint. Darkest: the one with the lowest sum of channels. Paper: darkest without gain compensation. (vote, darkest, paper)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Gain compensation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bring all to one brightness and contrast before they are compared.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of buildings or tiles worked on at the same time. The result does not depend on it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Dask scheduler</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Address of a Dask cluster that shares the work instead of workers on this machine, such as tcp://host:8786. The result does not depend on it. Inputs, outputs and temporary files must be on storage that all its machines see.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Orthophoto</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Without moving vehicles; 0 where there is no data.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the pixels that hold an image, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share with data</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Shifts between images</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points on road markings that two overlapping images show, with the shift of the second against the first in metres (east, north; sigma of one place), and the median of the pair with its sigma. Pairs that lie more than half a pixel apart have the status “apart”; “height” where only the height of what stands there may displace them, as no surface (DSM) tells.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Largest distance between the same road markings in two overlapping images that no height of what they show explains, median over their places; no value where none are seen.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum shift</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Images (*.tif *.tiff *.jpg *.jpeg *.TIF *.TIFF *.JPG *.JPEG)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The image: TIFF or JPEG, 8 or 16 bit.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera (*.json)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>JSON with focal_length_mm, pixel_pitch_mm, image_width, image_height, principal_point_mm and distortion, if there is any.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Table (*.csv *.txt)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CSV with the columns image, x, y, z, omega, phi, kappa; the frame is found by its file name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Surface</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the surface, from “Surface and ground from ALS”, in the CRS and height system of the exterior orientation.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground, likewise.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height threshold</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Surface higher than this above the ground, in metres, is masked: more than the highest vehicle.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Building outlines</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings that are masked even if they are lower than the threshold or partly missing in the surface. Outlines where nothing stands are left alone.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Low parts of buildings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Podiums and annexes lower than the threshold are masked too: higher than 2.5 m, wider than 4 m, within 15 m of something above the threshold.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Steep walls</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls drop from one cell of the surface to the next.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls at the cells' borders</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls stand at the border between a raised cell and a low one, not at the cells' centres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Method</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Refined: as set above. Paper: the triangles of the surface higher than the threshold as they are; low parts, steep walls and walls at the cells' borders are off. (refined, paper)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Unit of the angles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Automatic takes degrees and stops where the angles look like gon or radians. (automatic, degrees, gon, radians)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Order of the angles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>R_omega R_phi R_kappa as in the papers, or the usual R_kappa R_phi R_omega of most bundle adjustments. (papers, usual)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Occlusion map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>255 = shows a building or is hidden by one, otherwise 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the frame that is masked, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hidden share</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the frame that looks beyond the surface or the ground, where nothing is masked, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share not covered</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines that were masked.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines with a building</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines near the frame in which the surface shows nothing that stands.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines without a building</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>8 or 16 bit TIFF or JPEG images as the camera took them, each named in the exterior orientation.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>JSON file of the camera: focal_length_mm, pixel_pitch_mm, image_width, image_height, principal_point_mm, distortion.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exterior orientation (*.csv *.txt)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CSV file image,x,y,z,omega,phi,kappa (metres, degrees).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the bare ground in metres; the mosaic has its coordinate system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the surface (DSM) in metres, with which hidden ground is told.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground inside them is masked too.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Field with the buildings' height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Field of the outlines with the height above the ground in metres. Such buildings also hide what lies behind them, where the surface lacks them; without it only what the surface shows hides anything.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Resolution</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side of a pixel in metres; 0 for that of the frames.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Filter vehicles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take each pixel so that moving vehicles go; otherwise from the frame that looks down most steeply.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Majority vote: what most frames agree on, which also keeps dark vehicles from winning over paint. Darkest: the frame with the lowest sum of channels. Paper: as in the paper, darkest without gain compensation, of frames masked by their plain occlusion maps. (vote, darkest, paper)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bring all frames to one brightness and contrast before they are compared.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hidden ground</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground: told by lines of sight from the ground to the frame. Frame: told by an occlusion map of each frame, which masks it before ground is taken from it, as in the paper. (ground, frame)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Occlusion maps</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Occlusion maps of the frames, from “Occlusion map of a frame”, one for each frame in the frames' order; they are then taken instead of being made.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What stands higher than this above the ground, in metres, hides ground; vehicles should not.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Papers: R_omega R_phi R_kappa. Usual: R_kappa R_phi R_omega, as most bundle adjustments write. (papers, usual)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Automatic: degrees, and an error where they look otherwise. (automatic, degrees, gon, radians)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mosaic of the frames; 0 where there is no data.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frames that see the ground</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How many frames see each pixel.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the ground in the frames, outside buildings, that has an image, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Visible share</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground in the frames, outside buildings, that no frame sees.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Area of holes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>m²</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frames that gave pixels.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frames used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Aerial image on the ground, in a projected CRS (metres or feet).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No markings are looked for inside these polygons.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hidden areas</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Raster that is above 0 where the ground is not seen, such as an occlusion mask. Its cells may differ from the orthophoto's.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Roads</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markings are looked for only inside these polygons; without them, everywhere.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground heights in metres, in the orthophoto's CRS: gives the polygons their heights.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Profile: paint must stand out from the road on both sides, and what is no paint is left out. Paper: the plain adaptive Gaussian threshold of the grey image after a level adjustment, as in the paper; only block size and contrast matter then. (profile, paper)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Block size</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side of the block over which the mean is taken.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>grey values</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How much brighter than the mean paint is, in grey values of an image that goes from 0 to 255 after the level adjustment, whatever its bit depth.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Clean</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave out what is no paint by its width, contrast on both sides, shape and surroundings; without it all stays that is brighter by the contrast than the block.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum stroke width</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is wider than this in every direction is no paint.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum marking area</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smaller pieces are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum confidence</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markings (parts of long ones) with less confidence that they are paint on a road, 0 to 1, are left out: those on textured or coloured ground such as grass and earth, and faint ones. 0 keeps all. Where roads are given, the ground needs no proof.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Width of filled paint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Paint up to this width, such as arrow heads and letters, is filled between its edges; at most the maximum stroke width fills nothing.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points of “Orthorectify frames” that tell how far the frames of this orthophoto disagree; shown in the report.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Raster of “Orthorectify frames”; shown in the report.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Note for the report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Text that the report shows with its settings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Levels</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Low, high, middle and noise of the brightness of the image that this one is a part of; a run over tiles gives them. Left out: of this image itself.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marking mask</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>255 where there is a marking, otherwise 0; pixels as the orthophoto's.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines of the markings, with area (m2), length and width of the stroke (m), mean contrast (grey values), colour and confidence (0 to 1).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>HTML report (*.html)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>HTML report: numbers and areas, shifts between frames, coverage, pictures of the markings over the orthophoto, and what to distrust.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of polygons.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Area of the mask's markings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marked area</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Area in which markings could be found.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Searched area</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Point clouds</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One or several LAS, LAZ or COPC files in one projected coordinate system, heights in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side of a raster cell in metres. Finer than the distance between points shows nothing more.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How ground points are told. Automatic: by class where at least 1 % of the points have a ground class, otherwise by the cloth filter. (automatic, classes, cloth)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cloth resolution</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance in metres between the nodes of the cloth. Smaller follows the ground closer; larger spans more.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cloth threshold</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points within this height, in metres, above or below the cloth are ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cloth iterations</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum number of sweeps on each level of detail; the cloth stops earlier when it has converged.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cloth rigidness</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>3 for towns and large buildings, 2 for hills, 1 for steep mountains.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum edge length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Triangles of the surface with a longer side in plan, in metres, are left out, so that water and gaps stay empty; 0 keeps all.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground in gaps</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where triangles were left out, the surface takes the height of the ground instead of staying empty.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CRS of the point clouds</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Projected coordinate system in metres of files that state none; those that state one keep it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the surface (DSM) in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground in metres, without gaps inside the surface's outline.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Surface mesh</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PLY mesh (*.ply)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The triangles of the surface as binary PLY, which QGIS opens as a mesh layer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All points in the files.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points read</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points that are not noise or withheld.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground points as a share of the points used, 0 to 1; no value without a ground raster.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground share</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the surface's cells without a height, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Empty share</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the cells in triangles with a side of 10 m or more, where the surface is a guess, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share far from points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Triangles of the surface.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Triangles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Those longer than the longest edge.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Triangles left out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The drives: LAS, LAZ or COPC files with intensities and GPS times, or their markings as “Road markings of a mobile survey” writes them. Each file belongs to the trajectory along which it was measured.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Trajectories</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The trajectory of each drive, with which its points were placed: CSV time,x,y,z,roll,pitch,heading, SBET, or point layers.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles of the trajectory</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How roll, pitch and heading of tables and layers are counted: degrees or radians, headings clockwise from grid north or counter-clockwise from east. SBET says it itself. (degrees, radians, degrees_from_east, radians_from_east)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Geoid model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Geoid model (*.tif *.tiff *.gtx *.asc *.isg);;All files (*)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GeoTIFF, GTX or text grid of GSI (.asc, .isg) of the geoid's heights above the ellipsoid: with it the ellipsoidal heights of SBET become heights above sea level, as those of the points must be.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height of the geoid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One height above the ellipsoid for all places, instead of a model.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibration (*.json)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>JSON file of the scanners' (and cameras') lever arms and angles on the vehicle.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Control points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CSV or layer with the columns id,x,y,z (where a point truly lies, metres) and time,x_mms,y_mms,z_mms (when the survey measured it, GPS seconds, and where it lies in the survey). Heights may be missing.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Coordinate reference system</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Coordinate reference system of the control points, where their layer does not say it (CSV). It is needed for SBET trajectories.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reference markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The reference: a raster whose cells are above 0 where there is paint, or marking polygons. “Road markings from orthophoto” makes both.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground elevation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground in metres, for the reference markings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accuracy of control in plan</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of control points and of their measurement in the survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accuracy of control in height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same in height.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum error</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far drives may lie apart in plan.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ties by planes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Facades and road that two drives saw tie them too, across the facades and in height. Markings alone carry no planes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrected trajectories</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder in which each trajectory is written under its own name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ties</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One point an observation: its residual (m), its standard deviation and the weight that it kept.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrections</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points along the corrected paths, with correction, standard deviations and status.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residuals by kind, corrections and their uncertainty, what to distrust.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of ties between drives.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of ties by facades and road.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of their residuals.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMS of ties in plan</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In plan, over all drives.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median standard deviation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 where nothing fixes the place of the drives, otherwise 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Relative only</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The survey: one or several LAS, LAZ or COPC files with GPS times, as the reported trajectory places it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reported trajectory</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Trajectory (*.csv *.txt *.out *.sbet *.gpkg *.shp *.geojson);;All files (*)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The trajectory with which the survey was placed: CSV time,x,y,z,roll,pitch,heading, SBET, or a point layer with these fields.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrected trajectory</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same after the correction.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Image poses</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Image poses (*.csv *.txt)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CSV id,time,x,y,z,roll,pitch,heading of the survey's images.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points outside the trajectory</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is done with points that were measured before the trajectory begins or after it ends: move them with its nearest pose, keep them where they are, or refuse to run. Their number is told. (move, keep, refuse)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrected survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LAZ point cloud (*.laz);;LAS point cloud (*.las)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All points in their order, with all attributes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrected image poses</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same rows with corrected poses.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points written.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points measured outside the trajectory's time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points outside</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points measured in gaps of a trajectory of more than a second.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points in gaps</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean length of the movements.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean movement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum length of a movement.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum movement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The survey: LAS, LAZ or COPC files with GPS times and the number of the scanner as point source id. Each file belongs to the trajectory along which it was measured.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Difference of tilts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>degrees</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation by which roll and pitch of the trajectory differ from pass to pass.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Difference of headings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same of the heading.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrected calibration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The calibration file with corrected values; for each its standard deviation, or that it is not determined.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Table: scanner, parameter, correction, standard deviation, status.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrections with their standard deviations, and how far planes lie apart before and after.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Planes that were compared.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pairs of planes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance between planes before, trajectories corrected.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMS before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance between planes after.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMS after</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of values that are determined.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Determined</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same after a correction. Without it the survey is measured as it is.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One point at each control point, with the error before and after (m, east, north, up, in plan and in space).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Figures, errors over time, the worst points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean error in plan at the control points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean error in plan</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum error in plan at the control points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum error in plan</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of errors in plan at the control points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of errors in plan</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean error in space at the control points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean error in space</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum error in space at the control points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum error in space</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of errors in space at the control points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of errors in space</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Those measured during the survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Control points used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance in metres between the nodes of the cloth. Larger ones do not follow the ground well.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Iterations</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum number of sweeps on each level of detail; it stops earlier when the cloth has converged.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Threshold</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum ground share</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A smaller share of ground among the points, 0 to 1, is refused: it shows that the filter has failed. 0 accepts every share.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Classified points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All points; ground has class 2, what was undecided and is no ground class 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points of class 2 in the result.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground points as a share of the points used, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Passes through the same place that were filtered apart.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Passes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Trajectory</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where the vehicle was: CSV time,x,y,z,roll,pitch,heading (GPS seconds, metres, degrees), Applanix SBET, or a point layer with these fields.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same epochs in the format of the trajectory given.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A survey (LAS, LAZ or COPC with intensities and GPS times) or, faster, its markings as “Road markings of a mobile survey” writes them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where the vehicle was: CSV time,x,y,z,roll,pitch,heading (GPS seconds, metres, degrees; with sd_roll,sd_pitch,sd_heading where their accuracy is known), Applanix SBET (with its smrmsg file beside it), or a point layer with these fields.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground in metres, in the height system of the survey. With it the correction is in space.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Patch length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of path that counts as rigid.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum window length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>patches</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Patches of the shortest window. By default 60; 30 with the paper's method in space.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum window length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Patches of the longest window, which is used as it is even where it has too few markings. By default 200; no limit with the paper's method.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Feature grid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side of the cells in which markings are counted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Feature count</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>cells</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cells with markings that a window should have. In space the paper's method counts marking points instead, 5 for each of these cells.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>NDT grid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side of the cells of the normal distributions.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Most steps of each adjustment.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Subsampling</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One point is used in each cell of this side. By default 0.1 m; 0.3 m with the paper's method.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far off the survey may be in plan. Where the best place lies at the edge of it, or hardly beats others, twice as far is looked at. Wider than half the distance between dashes invites a slip by one dash.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Full, or as in the paper to the letter: windows as rigid bodies, each started from the one before, and each patch moved by the matrix of its own window; no model of the drift, no weights, no bridging. In plan as in 3.2.4, with ground heights as in chapter 4. (full, paper)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accuracy of the reference</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of the error that all reference markings around a place share (orientation of the frames, for example): no survey can show it, so that it is part of every standard deviation. The default holds where the reference counts as true; otherwise give what control points say of it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accuracy of the ground</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of the errors that neighbouring heights of the ground share; they must not turn the vehicle. By default found from how the ground bends against the survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accuracy of roll and pitch</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of the reported roll and pitch; that of the heading is twice as large. Not used where the trajectory states its own (columns sd_roll, sd_pitch, sd_heading, or the smrmsg file beside an SBET).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum trusted standard deviation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A patch whose standard deviation in plan is larger is not to be trusted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Aerial image</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Shown behind the markings in the report.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Patches</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One point a patch at its corrected place, with correction (m, degrees), standard deviations, window, score, status and its reason.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Correction and its uncertainty along the path, pictures before and after, what to distrust.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of the driven path.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Path length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In plan, over the path.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean correction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In plan.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum correction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the path that is registered, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Registered</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the path that is bridged, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bridged</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the path not to be trusted, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not to be trusted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum standard deviation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The survey: LAS, LAZ or COPC files with intensities and GPS times, in one projected coordinate system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points farther from the scanner, in metres, are left out. The range up to which the curve holds (R2) may be shorter.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side in metres of the block whose mean a marking exceeds.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Full, or as in the paper to the letter: the adaptive threshold of block and grey contrast alone, on an image of 12 cm; contrast, stroke width and length do not count then, and kerbs, feet of walls and specks stay. (full, paper)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Grey contrast</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>With the paper's method: by how many grey levels of 256 a marking exceeds the weighted mean of its block (c). White is the intensity that 0.1 % of the ground exceeds.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How much brighter than the ground a marking is, as a share of the ground's intensity.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is wider in both directions, in metres, is no marking but ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Shorter pieces, in metres, are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance in metres between the nodes of the cloth.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Most sweeps on each level of detail; the cloth stops earlier when it has settled.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marking points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points on markings with all their attributes, and calibrated_intensity (asphalt has the reference intensity) and marking_weight (0 to 1: how far above the middle between ground and paint).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Intensity over range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Page with plot, table and quality of the fit of each scanner.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground points within range of the vehicle.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points in the result.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marking points as a share of the ground points that could be judged, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marking share</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median intensity of marking points, in units of that of the ground beside them; no value without markings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Contrast of paint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>By how much asphalt in bins of range departs from the curve, as a share of it (robust standard deviation; worst scanner).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residual of the fit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of single asphalt points round the curve, as a share of it (of the same scanner).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scatter of asphalt</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scanners with a curve.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scanners</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>R2: range up to which points are used.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum range used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the path, by 20 m, with marking points, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Path with markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points at times for which the trajectory has no place, or at which the vehicle stood.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points left out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line images</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Strip images of line cameras, one column a time, each with the table of its columns' times beside it (column,time).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Perspective images, each named in the exterior orientation.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>JSON file of the frames' camera.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CSV file image,x,y,z,omega,phi,kappa of the frames.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Building models</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MultiPolygonZ with all faces of each building, such as those of “Building models”; the field building_id names them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Laser points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points of the survey; what stands before a facade hides it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side of a pixel on the facade.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line images are used up to this distance.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum share seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Facades of which images show less get no texture.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Textured model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>glTF binary (*.glb);;Wavefront OBJ (*.obj);;CityJSON (*.city.json *.json)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>By its ending: .glb holds its images; .obj and .city.json have theirs in a folder beside.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder of all kinds</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The model as glTF, OBJ and CityJSON with its images.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Facades</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PolygonZ, one feature a facade: building_id, facade, area (m2), azimuth (degrees), seen (share), detail (m, size of the images' pixels), images, status, reason.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of facades.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Facades with a texture.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Textured facades</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of all facades' area that images show, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range scans</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One or several tables of time, angle, range, intensity and scanner (CSV, CSV.GZ, Parquet, LAS, LAZ).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the trajectory, where its layer does not say it; it is written into the point cloud, and needed for SBET trajectories.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Returns from farther away, in metres, are left out; 0 takes each scanner's own limit from the calibration.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nearer returns, in metres, are left out, such as those of the vehicle itself.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Unit of the angles in the file. (degrees, radians)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Point cloud</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points with gps_time, intensity, point_source_id, angle and range.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Returns in the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Returns</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Returns left out for want of a range or angle.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Without a range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Returns left out because they are too near or far.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Beyond the range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Returns left out because they were measured outside the trajectory or in a gap of it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outside the time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Laser points of the survey, LAS, LAZ or COPC, placed by the same trajectory.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Polygons, lines or points drawn on the images, in pixels.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Laser points farther from the camera are not used (line images).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Objects</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One feature an outline, with z: the fields of the outlines and width, height (m), azimuth (degrees, where the surface faces), area (m2), z_low, z_high, distance (m, from the camera), points, rmse, sigma (m), status, reason.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of outlines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines that became features with a place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median standard deviation of the corners' places against the laser points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median sigma</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Image of the map, in the CRS of points and lines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Laser points to draw, LAS, LAZ or COPC.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Models or lines</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Building models (MultiPolygonZ with all faces) or lines with heights; their edges are drawn.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Colour points by</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What the colours of points tell (height, intensity, class, one)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Laser points before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same points before a correction.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Models or lines before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same models or lines before a correction.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Trajectory before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line images show things up to this distance.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pictures on the page</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At most so many; the fullest windows are taken.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder of images</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Each image with the overlay as JPEG, and the pictures of the page before and after beside each other.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Page</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Page that switches between plain image, before and after.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Images in which points or edges lie.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Images drawn on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Images in which nothing lies.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Images without</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The reported trajectory: CSV time,x,y,z,roll,pitch,heading (GPS seconds, metres, degrees), Applanix SBET, or a point layer with these fields.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tie points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CSV or layer with set,time,x_mms,y_mms,x_ref,y_ref: name of the set, when the survey measured the place (s), where it lies in the survey and in the reference (m). In a line layer with set and time each line may run from survey to reference instead.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground, or a surface, along the course: then heights are corrected too.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height of the origin</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height of the trajectory's origin above the ground, in metres. Without it the mean height stays as reported.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Best estimate of the drift from all tie points; or relative motions adjusted between sets in closed form; or the same by the paper's iteration; or the whole paper to the letter. (drift, relative, iterative, paper)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sigma of tie points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of a tie point's coordinate in metres; 0 finds it from the tie points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Expected error of the heading</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation in degrees: what is known of the heading where the pairs of a set lie close together.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep doubtful sets</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Use sets even though the other sets put them elsewhere.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of trajectory and tie points, where no layer says it; needed for SBET trajectories.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line images for the report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Strip images of line cameras: the report shows the models or lines over them, before and after.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Models or lines for the report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Building models (MultiPolygonZ) or lines with heights, drawn over the line images.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rectified trajectory</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sets</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One point a set: distance from the reference before and after, correction, misfit within the set, how far off it would lie without itself (predicted), and its status.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Epochs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One point an epoch: correction, sigma and status (between sets, or carried on (extrapolated) before the first or after the last).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Before and after, set by set, as HTML.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sets of tie points within the trajectory's time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sets that were not left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sets used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean distance of the tie points from the reference as reported.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same after the rectification.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance after</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean over the sets of how far a set would lie off if it were not used.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Off without itself</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean standard deviation of a plan coordinate between the sets.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean sigma</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Largest of all epochs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum sigma</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the epochs before the first or after the last set, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share extrapolated</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Root mean square distance from the ground as reported; no value without a ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height after</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The survey, placed with the trajectory: one or several LAS, LAZ or COPC files with GPS times.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines of the walls in the survey's coordinate system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum distance</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corners farther from the course, in metres, are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Search range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far survey and outlines may lie apart, in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Agreement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Shifts of neighbouring corners that differ by less, in metres, agree: as good as the outlines are.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines from the survey to the reference with set, time (s), length (m), support (other corners shifted likewise) and fit of the walls (m).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corners of outlines near the course.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corners</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corners that the survey shows.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corners found</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sets of two tie points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean distance between survey and reference.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Roof polygons</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Polygons from “Roof polygons” with the fields building_id, roof_id and height (m).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines from “Segment buildings”. Each gets a row in the result. A field ground gives the height of the ground in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground in metres; the lowest along an outline is the base of its walls.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Base height field</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Field of the buildings with the height of the base of the walls in metres; used where there is no ground elevation.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Roof points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points with building_id and roof_id, from “Segment roofs”, for the figures of fit.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Roofs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>planes: roofs as the polygons' heights have them (LoD2.2 where any is sloped); levels: every roof at its one height (LoD1.3). (planes, levels)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Text that the report shows with its settings, such as the name of the project.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MultiPolygonZ, one feature a building with all faces of its solids; status, reason, roofs, base, height (m), area (m2), volume (m3), points, density (points a m2), rmse_z, rmse_z95, median_dz, rmse_3d, p95 (m), coverage, unseen (shares), lod, roof_type, not_explained (share of the points that can be roof and lie far from the model), quality (0 to 1), roof_min, roof_50, roof_70, roof_max (m above the ground), volume_lod12, volume_lod13, volume_lod22 (m3), area_roof_flat, area_roof_sloped (m2), storeys_estimated.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Surfaces</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MultiPolygonZ, one feature a surface, with building_id, roof_id and surface_type: roof, outer wall, inner wall, ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityJSON</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityJSON (*.city.json *.json)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityJSON 2.0 file with outlines and solids at the levels of detail 0, 1.2, 1.3 and 2.2, surface types, the fields of the outlines and the figures of each building.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>OBJ mesh</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wavefront OBJ (*.obj)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wavefront OBJ file, a group for each building.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>HTML report: counts, quality, the worst buildings with reasons.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings with a model.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Modelled</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean over the buildings, where points were given.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean RMSE of height, best 95 %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LAS, LAZ or COPC files; they become one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Raster of heights</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Such as a ground elevation.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Layer with heights</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Features with z, such as building models.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height system of the data</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>JGD2000, JGD2011, JGD2024, ellipsoidal or the EPSG code of a vertical system; needed where the data do not state it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height system of the result</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Likewise.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Grid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrections (added to the older system's heights) or a geoid model: GSI's text grid (.isg, .asc), GeoTIFF or GTX, in latitude and longitude, m.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One value</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Instead of a grid, one correction or geoid height for all places.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Against the grid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The corrections of the grid lead from the result's system to that of the data.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>With converted heights, all attributes kept.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Raster</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>With converted heights.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Layer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The features with converted z. Heights in fields, such as base or ground, stay as they are: a warning names them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of all heights.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Least change</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean change</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Largest change</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MultiPolygonZ with all faces of each building, such as those of “Building models”. Without it give a city model.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>City model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityGML (.gml, .zip) or CityJSON file instead of the layer: its buildings are written with all that they hold, and nothing is added.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Surfaces of “Building models”, for the roofs' ids and the types of walls; without them types are told by the faces.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityJSON file of “Facade textures” of the same buildings: its images go along.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Id field</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Field with the source's own ids. Without it gml_id or building_id is taken.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height system</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What heights count from, where the layer's CRS does not say it: JGD2011, JGD2024, ellipsoidal or the EPSG code of a vertical system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GeoTIFF, GTX or text grid of GSI (.asc, .isg) of the geoid's heights above the ellipsoid: 3D Tiles then have ellipsoidal heights, as globes want them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Municipality's code</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Five digits, such as 13101: CityGML then has the buildings' ids as PLATEAU asks for them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Date of the data</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Day on which the buildings were measured, such as 2026-04-01.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Title</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Title of the data set.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings with figures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The models with the fields of the layer, city_id, ground_height, roof_min, roof_50, roof_70, roof_max (m above the ground), volume_lod12, volume_lod13, volume_lod22 (m3), area_ground, area_roof_flat, area_roof_sloped, area_outer_walls, area_party_walls (m2), storeys_estimated, data_date, problems. A name ending in .parquet gives GeoParquet where GDAL has it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityJSON 2.0 file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityJSONSeq</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityJSONSeq (*.city.jsonl *.jsonl)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityJSON sequence, a line a building, for large areas.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityGML</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder of CityGML 2.0: in Japan udx/bldg with a file a mesh, EPSG:6697, and codelists; elsewhere one file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>3D Tiles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder with tileset.json and its tiles.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings of which a solid is not closed or not valid.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not closed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>City models (*.gml *.GML *.zip *.json *.jsonl *.xml);;All files (*)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityGML (.gml, or a .zip of them), CityJSON (.json) or CityJSONSeq (.jsonl). The path of a folder, such as that of a PLATEAU data set, can be typed here as well.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder of city models</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All city models in this folder and its subfolders; instead of the file or beside it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Projected system of the result. If none is chosen, that of the model, or for degrees in Japan the zone of the Japan Plane Rectangular CS in which the first building lies.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CRS of the city model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of files that name none.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MultiPolygon outlines (footprint, else roof edge, else the plan of the solid) with building_id (the model's own id), lod (levels there are), ground and top (heights in m), height (m, measuredHeight where it is given), parts, note (what is wrong), attributes (all, as JSON), and simple attributes as fields.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MultiPolygonZ, one feature a building with all faces of its most detailed solid, as “Building models” writes them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PolygonZ, one feature a face, with building_id, roof_id and surface_type: roof, outer wall, inner wall, ground, overhang.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of buildings written.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of buildings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings in which something is wrong.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings with a note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As the model says it: unknown, JGD2011, JGD2024, ...</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>File of building outlines</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GSI building outlines (*.xml *.XML *.zip *.ZIP);;All files (*)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>FG-GML-...-BldA or -BldL .xml, or a .zip as downloaded (zips inside are opened too). The path of a folder can be typed here as well.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder of building outlines</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All .xml and .zip files in this folder and its subfolders; instead of the file or beside it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the result. If none is chosen, the zone of the Japan Plane Rectangular CS (JGD2011, EPSG:6669 to 6687) in which most buildings lie; close to the border of a prefecture, check it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Footprints</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Polygons with building_id (1, 2, 3, ... in the order of the files), the GSI's attributes as text (its fid as gsi_fid) and the file's name as source.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of footprints written.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Coordinate reference system of the result, such as EPSG:6677.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Name of the coordinate reference system</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>File of an elevation model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GSI elevation models (*.xml *.XML *.zip *.ZIP);;All files (*)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>FG-GML-...-DEM5A-... .xml (or 1A, 5B, 5C, 10A, 10B), or a .zip as downloaded (zips inside are opened too). The path of a folder can be typed here as well.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder of elevation models</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the raster. If none is chosen, the zone of the Japan Plane Rectangular CS in which most meshes lie. In degrees (EPSG:6668) the cells stay as they are in the files.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cell size</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side of a cell in units of the coordinate reference system; if none is given, that of the finest product: 1, 5 or 10 m, or its fraction of a second.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GeoTIFF of heights in metres; cells without height are no data.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of files that the raster was made of.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of meshes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cells without height (sea, or no mesh), 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of empty cells</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>JGD2000, JGD2011 or JGD2024, as the files say.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MultiPolygonZ of “Building models”: level roofs, upright walls. Without them give a CityJSON file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Building models (CityJSON)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityJSON file with solids, in the coordinate system of the walls, instead of the layer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PolygonZ of “Walls from a mobile survey”. Walls of few points, rough ones and those inside the outlines are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height in metres above the ground of each model up to which measured walls are taken.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum offset</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum distance in metres by which a wall moves to the measured one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum rotation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>°</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum angle between a wall and the measured one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum share measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum share of a wall's length, 0 to 1, that must have been measured for it to move.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum overhang</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A roof that stands out further than this over the measured wall stays where it is, in metres; others follow the wall.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Merged models</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MultiPolygonZ, one feature a building with all faces of its solids; status, reason, valid, walls, walls_moved, measured (share of the walls' length), mean_offset, max_offset, base, height (m), volume, volume_change (m3).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls of the models</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PolygonZ, one feature an outer wall below the height, with what became of it: building_id, edge, status, note, wall (row of the measured wall), length, offset (m), turn (degrees), seen (share), rmse, sigma (m).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityJSON 2.0 file with the solids.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Orthophoto for the report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The report shows edges before and after over it; it changes nothing else.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What was merged and what not, and edges before and after over the orthophoto, as HTML.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of models.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings with a wall that moved.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Merged</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings that could not be merged.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not merged</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings whose solids passed the check.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Valid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outer walls that lie on measured ones now.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls moved</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points with building_id from “Segment buildings”, or any points of airborne scanning.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One feature a building, where it stands. A field ground gives the height of the ground in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance in metres from the mesh within which at least 95 % of a building's uppermost points shall lie.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground in metres; the lowest along an outline is the foot of its walls.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height step</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Steps of the roof higher than this, in metres, become upright walls.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum area of a surface</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smaller pieces between steps become part of what is beside them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Meshes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MultiPolygonZ, one feature a building with all triangles; status, reason, triangles, surfaces, base, height (m), points, rmse, p95, max_error (m), within (share of the uppermost points), watertight, valid.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PLY mesh</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All meshes in one binary PLY file, which QGIS opens as a mesh layer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings with a mesh.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Meshed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Meshes that are closed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Watertight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the uppermost points within the stated error.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points within the error</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of all points from their meshes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMSE</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of all triangles.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points with the attributes building_id and roof_id, from “Segment roofs”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines from “Segment buildings”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How the polygons are drawn. (partition, points, paper)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>planes: polygons on the planes of their points, with edges where planes meet (LoD2.2); levels: level polygons (LoD1.3). The paper's method has levels always. (planes, levels)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Roof height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height of a level roof from its points: the median, or the highest point as in the paper (the top of the parapet). The paper's method always takes the highest point. (robust, maximum)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum points of an edge</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Boundary points that a line must have to be an edge, in the paper's method (its n).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PolygonZ at the roofs' heights: building_id, roof_id (0: plain block), height, height_max (m), points, density (points a m2), rmse (m), coverage (share of the area with points), boundary_rms (m), slope (degrees), azimuth (degrees from north, where it falls to), status.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines that got no polygon.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings without a roof</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rough outlines, one feature a building, in the same coordinate system as the points. A field building_id, of any type, names the buildings and comes back in every result; ids that a point cloud cannot hold get a number beside them (bldg_no). Without it, buildings are numbered from 1 in the layer's order.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Expansion</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance in metres by which outlines are expanded before they take their points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The full method adjusts the outlines and chooses the points that can be building. The paper's takes all points in the expanded outlines as they are given; a point in several is written once for each. (full, paper)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground in metres. Without it the ground is made from the points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum displacement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance in metres by which an outline may be moved to its points; 0 leaves all outlines in their places.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum building height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height in metres above the ground from which points without a class can belong to a building.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Building points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The points of the buildings with the attribute building_id, building after building; all other attributes are kept.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The outlines at their found places, with building_id, points, density (points a m2), ground (m), shift_x, shift_y, shift_sigma (m), shift_status, status and open_share (share of the outline cut out as open ground).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines with too few points for a model.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings without points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points given to buildings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points with the attribute building_id, from “Segment buildings”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines from “Segment buildings”; their fields ground and density are used where they are there.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The full method segments roofs in the histogram and in plan. The paper's has the histogram alone: all points in the expanded outline, maxima of at least the minimum roof area times the density; it uses bin width, bin shift, minimum roof area and parapet threshold only. (full, paper)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>planes: level and sloped roof planes (LoD2.2); levels: level roofs, sloped ones cut into steps (LoD1.3). The paper's method has levels always. (planes, levels)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bin width</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Width of a histogram bin in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bin shift</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance in metres from one bin to the next; smaller than the width, so that bins overlap.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum roof area</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Area in square metres that a maximum of the histogram must hold to be a roof (times the density: the paper's alpha).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Parapet threshold</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Two maxima are one roof where the histogram between them stays above this number of points (the paper's beta). Without it, 0.3 of the smaller maximum; with the paper's method, 0.3 of alpha.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum roof share</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The minimum roof area is no more than this share of the outline's area, so that small buildings have roofs too; 1 asks for the minimum roof area everywhere but in buildings smaller than that.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum area of a small roof</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Area in square metres of the smallest part that stands out in height and becomes a roof of its own.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height error of sloped roofs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sloped roofs are cut into level ones until the building's root mean square height error in metres is below this; 0 keeps the roofs of the paper whole.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum roof height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height in metres above the ground below which nothing is a roof.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Plane tolerance</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Largest distance in metres of a point from its roof plane; three to four times the noise of the heights.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum area of a plane</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Area in square metres of the smallest roof plane.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The buildings' points with the attribute roof_id: the number of the roof in its building, 0 for trees, walls and roof furniture.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Table of the roofs: building_id, roof_id, height (robust, m), height_max (highest point as in the paper, m), points, area (m2), density (points a m2), rmse (m), slope (degrees), azimuth (degrees from north, where it falls to), status.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of roofs found.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings in whose points no roof was found.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mobile survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One or several LAS, LAZ or COPC files of a survey that lies on the map, such as from “Apply corrected trajectory”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines, or models with their heights (MultiPolygonZ of “Building models”). A field building_id, of any type, names the buildings; without it, buildings are numbered from 1 in the layer's order.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height in metres above the ground up to which points are used.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground in metres. Without it the ground is taken from the lowest points round each building.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tolerance of the outlines</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far the outlines may be off, in metres: walls are looked for up to this far from the edges. Inside, setbacks are found at any distance.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum area of a wall</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tolerance</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum distance in metres of a wall's points, on the mean of 30 cm, from its plane.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum gap</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A wall may be interrupted by up to so many metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum opening</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smaller holes in a contour are filled, and their share is reported.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PolygonZ, one feature a contour: building_id, wall_id, status, note, area (m2), height, length (m), azimuth and tilt (degrees), normal_x, normal_y, normal_z, points, passes, rmse, sigma, pass_spread (m), coverage, hidden, unseen, openings, filled (shares), edge and offset (outline edge, and m before it).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of contours.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings of which a wall was found.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings with walls</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings near points of the survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings reached</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Area of all contours.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Area</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median over the walls of the standard deviation of their place in the survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Building models (MultiPolygonZ, such as those of “Building models”) or outlines with heights, in a projected CRS in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where the receiver was, in the CRS of the buildings: one or several files (CSV time,x,y,z,roll,pitch,heading, SBET, or point layers).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Observations</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RINEX 2.11 or 3.x observation files, plain or gzipped; each file is a pass.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Navigation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RINEX navigation files or SP3 orbits of the same days.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Geoid separation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ellipsoidal height minus the trajectory's height; 0 where the trajectory has ellipsoidal heights. Left empty, it is estimated from the satellites.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Elevation mask</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Satellites lower than this are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lever arm of the antenna</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Antenna in the vehicle's body: forward, right, down, in metres from the trajectory's origin.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Field with the building</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Features with the same value are one building. Left empty, building_id or building is taken where it exists.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Field with the height of the top</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height of the top of the walls, m, in the trajectory's heights. Needed for outlines without heights; z_top is found by itself.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Field with the height of the foot</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height of the foot of the walls, m; without it the walls of outlines reach down without end. z_base is found by itself.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum range of reflections</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls farther from the antenna than this reflect nothing that is received, m.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Satellite systems</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Letters of those that are used: G GPS, R GLONASS, E Galileo, C BeiDou, J QZSS.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum number of passes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls seen in fewer observation files stay.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum number of observations</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls with fewer independent observations stay.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum number of satellites</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls seen by fewer satellites stay.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls whose offset has a larger standard deviation stay.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Expected offset</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far walls are off before anything is measured (standard deviation).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Adjusted buildings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The buildings with their fields, and walls_adjusted (number of walls moved by their own observations) and walls_moved_by (m, largest).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LineStringZ where each wall now stands: building, edge, status (adjusted, not observable, held), reason, offset and sigma (m, outwards), applied (m moved), observations, signals, satellites, passes, on_time (share of the observations that are neither NLOS-delayed nor outliers), distance (m to the nearest antenna), length, low, top (m).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>HTML report: sky plot, residuals by class against prediction, walls before and after, what to distrust.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of walls.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls that were moved by their own observations.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Adjusted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Independent observations of all walls.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Observations used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Observation files with usable signals.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the offsets of the adjusted walls.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Size of the offsets of the adjusted walls.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median offset</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Seconds between lines</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines are drawn of epochs this far apart; figures are those of all.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of the lines</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the part towards the satellite.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rays</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LineStringZ: time, pass, satellite, system, kind (LOS, NLOS, reflected), sure, elevation, azimuth (degrees, from grid north), cn0, excess (predicted excess path, m), residual (m), difference (residual minus excess), reflections (number of walls that can have reflected it), building, edge (of the wall).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>HTML report: sky plot, residuals by class against prediction, what to distrust.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of signals.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Signals</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In line of sight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of signals without a single wall to reflect them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Blocked</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reflected</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>After the receiver's clock.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median residual in line of sight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the residuals.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Quartile range in line of sight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the reflected signals within 5 m of prediction.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Within 5 m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the reflected signals within 10 m of prediction.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Within 10 m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RINEX navigation files or SP3 orbits of the day.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drives along which to count, in the CRS of the buildings: CSV time,x,y,z,roll,pitch,heading, SBET, or point layers. Left empty, an area is filled.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time in UTC for an area, such as 2024-04-18 02:30:00; a trajectory has times of its own.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Area to fill where no trajectory is given; left empty, that of the buildings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance in metres between the places in an area.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground in metres, for an area. Without it the ground is level at the feet of the buildings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height of the antenna</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Above the ground, in metres, for an area.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Seconds between places</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Along a trajectory.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Satellites lower than this are not counted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Letters of those that are counted: G GPS, R GLONASS, E Galileo, C BeiDou, J QZSS.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Visible satellites</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PointZ: time (of the trajectory, or GPS seconds), satellites (in line of sight), gps, glonass, galileo, beidou, qzss (of them), above (satellites above the mask, hidden ones too), pdop.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Visible satellites over the area</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of satellites in line of sight; no value inside buildings. Only without a trajectory.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Satellites in line of sight, mean over the places.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the places with fewer than four satellites in line of sight, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share below four</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the places where the satellites in line of sight fix no position, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share without a position</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of different satellites above the mask.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Satellites</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lanelet2 file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lanelet2 (*.osm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>OSM file, such as that of “Lane map”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Faults of the map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points (longitude, latitude): rule, severity (error, warning, info), text, element. Faults without a place have no geometry.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>HTML report: numbers by rule, and the faults.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of lanelets in the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lanelets</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of errors.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Errors</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of warnings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Warnings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Building models (MultiPolygonZ, such as those of “Building models”) or outlines with heights, in a projected CRS in metres. Leave them out to ask for markings alone.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls with sigma</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls whose accuracy was measured (field sigma), such as those of “Merge building models” or “Adjust walls by GNSS”: walls of the buildings that run along them take their sigma.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sigma of walls</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of the place of a wall across itself, where neither a field nor WALLS tell it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Polygons or lines of markings, such as those of “Lines from road markings” (field sigma).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sigma of markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of the place of a marking, where no field sigma tells it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Common sigma of markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of a displacement that the markings around a place share, such as that of the aerial block.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines along which vehicles drive, such as centre lines of lanes. A field tunnel (yes, 1) is heeded.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drives in the CRS of the buildings instead of roads.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Area to fill where neither roads nor trajectories are given; left empty, that of the map. Along is then north.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spacing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance between the places.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground in metres. Without it the roads' heights are taken, or the feet of the buildings beside them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Features with the same value are one building.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>m; z_top and top are found by themselves.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>m; z_base and ground are found by themselves.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Field with the sigma of walls</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of a building's walls, m; wall_sigma and sigma_xy are found by themselves.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RINEX navigation files or SP3 orbits: then satellites count too.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time in UTC for roads and areas, such as 2024-04-18 02:30:00; left empty, six times over the hours of the navigation files. A trajectory has times of its own.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Satellites lower than this are not used.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>G GPS, R GLONASS, E Galileo, C BeiDou, J QZSS.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scanner</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the vehicle to be localised. (2D, multi-layer)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range of the scanner</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls farther away are not seen.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height of the scanner</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Above the road.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Matching</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How scans are matched to the map. (NDT, ICP)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angular resolution</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Between rays of a layer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Noise of ranges</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Layers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of a multi-layer scanner.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lowest layer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Its elevation.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Highest layer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of hidden rays</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rays that end at vehicles, trees or people.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cells of the NDT</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Common sigma of a building</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of a displacement that all walls of a building share.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sigma before matching</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is known before, of east and of north: a direction without evidence keeps it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sigma of the heading before matching</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Search for repetitions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Places that look alike are searched for within this distance; 0: not at all.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range of markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markings farther away are not seen.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>View of markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angle ahead in which markings are seen: 360 for the intensity of a scanner around, about 100 for a camera.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Detection rate of markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the markings within sight that are found.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sigma of satellite ranges</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of a code range at the zenith.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of reflected signals</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the hidden satellites those that are received by reflection and used.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Limit of good</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Largest sigma of the weakest direction of a good place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Limit of usable</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same of a usable place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulate scans</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scans are simulated at some places and registered to the map: observed against predicted accuracy in the report and among the results.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulate every</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At every so many places that see walls.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scans a place</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Each in another true city, as the sigmas of the walls allow.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>True buildings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The true city to simulate in, with heights as BUILDINGS has them; without it the map is displaced by its sigmas.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the simulation.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Localisation accuracy</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points along the roads: sigma_along, sigma_across (m), sigma_heading (degrees) together, and of each source (…_walls, …_markings, …_satellites); major, minor (m) and weakest (bearing of the major axis) of the error ellipse; alias_share, alias_distance, alias_bearing; points, n_walls, horizon and sky (share with walls), cell_rms, two_surfaces, satellites, pdop; class and status.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Localisation accuracy, raster</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sigma of the weakest direction, m, in cells of the spacing.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road by class, the worst stretches with pictures, and what was simulated.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of places.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Places</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the weakest direction, over the places that have one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road of class good.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of good road</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road of class usable.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of usable road</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road of class poor.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of poor road</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road of which nothing can be said.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of road without</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of places that look like others.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repeated places</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of observed and predicted errors, where scans were simulated.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spearman's coefficient</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of simulated errors within the 95 % ellipse.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share within the ellipse</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Polygons of the markings, such as those of “Road markings from orthophoto”, in a projected CRS in metres. A field colour (white, yellow) is used where there is one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground in metres, in the CRS of the markings: gives lines and areas their heights.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of the markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How well the places of the markings are known as a whole, in metres; it enters the lines' sigma.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum line length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Shorter lines are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum line width</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wider strokes are no part of a line.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marking lines</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines, with heights where a ground is given: class (solid, dashed, stop line, guiding strip), colour, width (m), sigma (m, across), length (m), bridged (m without paint that should be there), period and dash (m), dashes (begins and ends along the line, m), chain (sections of one line), partner (chain that makes it a double line), confidence (0 to 1: share of the paint that should be there and is seen; of a stop line less where only lines' ends or only a crosswalk show it).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marking areas</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Polygons: class (crosswalk; arrow straight, ..., or arrow, kind unknown; diamond; unknown), colour, heading (degrees from grid north in which it is read), score (0 to 1: agreement with the shape; of a crosswalk paint at its bars' places less that between them).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of lines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of all lines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of crosswalks.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Crosswalks</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the area of the markings that is neither line nor known shape, 0 to 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Unknown paint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The survey, placed by the trajectory: LAS, LAZ or COPC files with GPS times, in one projected coordinate system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights of the ground in metres, from which those of the points are counted. Without it the ground is found among the points; where the raster has no value no edge is found.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Half width</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Edges up to so far from the path, in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lowest kerb</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lower steps, in metres, are no kerbs; between two parts of a kerb they are its lowered places.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Highest kerb</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Higher steps, in metres, are no kerbs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Shorter edges, in metres, are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of the survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How well the survey is placed as a whole, in metres; it enters the sigma of all edges.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Objects of “Objects from images” for the GeoPackage.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls of “Walls of the mobile survey” for the GeoPackage.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road edges</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LineStringZ along the foot: edge_id, kind (kerb, lowered kerb, road border, guard rail, wall), height, sigma (across), sigma_z, length (m), points, passes, completeness (share of the line that was measured), chain (parts of one edge), gap (m to the next part), status (measured, doubtful), reason.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Upper edges</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same along the top: edge_id, kind, height, sigma, sigma_z, status.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All features</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GeoPackage (*.gpkg)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One GeoPackage with the layers edges, upper_edges and, where given, objects and walls.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Edges</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Kerbs and lowered kerbs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of kerbs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Without a kerb.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of road borders</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measured and doubtful ones.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of guard rails</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls at the road.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of walls</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median standard deviation of measured kerbs across; no value without kerbs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines of “Lines from road markings” (fields class, colour, width, sigma, chain, partner; class alone is enough), in a projected CRS in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Crosswalks and arrows of “Lines from road markings” (fields class, heading).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines of kerbs, road borders or rails, in the CRS of the lines: they are bounds of lanes too.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrected trajectories of drives in the CRS of the lines: they show directions and ways through junctions.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road axes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Axes of roads of another map, in the CRS of the lines, with any of the fields oneway, lanes and speed_limit or maxspeed as OpenStreetMap has them: they tell directions where nothing else does, and speed limits.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side of the traffic</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Auto: the side that drives in both directions show, left where they do not. (auto, left, right)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Minimum lane width</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Narrower strips are no lanes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Maximum lane width</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wider strips are no lanes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Longest unseen bound</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A bound is drawn through gaps of its line up to this length, which are told.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Speed limit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>km/h</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of lanes for which road axes tell none; left empty, they have none.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Projector</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the local coordinates in the Lanelet2 file, for Autoware. (TransverseMercator, MGRS)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Vertical datum</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the lines' heights, for Autoware's projector file. (not stated, WGS84, EGM2008)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lanes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Polygons: lane_id, kind (lane, virtual), direction's evidence, width and narrowest (m), turn, arrows, successors, left, right and opposite (ids of neighbours), stop_lines and crosswalks (numbers).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Centre lines of lanes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines in the direction of traffic: lane_id, width (m).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bounds of lanes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines: bound_id, class, colour, width, sigma (m), double, unseen (m without a line), lanes (number of lanes that have it).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lanes, stop lines and crosswalks with Autoware's tags.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Projector file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>YAML (*.yaml)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Autoware's map_projector_info.yaml of the Lanelet2 file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>OpenDRIVE file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>OpenDRIVE (*.xodr)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Roads, junctions, road marks, stop lines and crosswalks as ASAM OpenDRIVE 1.7; coordinates are those of the CRS less the header's offset.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Findings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points: kind and a sentence on what is missing or contradicts.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>HTML report: verdict, figures, pictures of the junctions and findings with their places.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of lanes, virtual ones included.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of their centre lines, virtual ones not counted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of lanes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of findings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Airborne laser points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Vote and darkest: our way, with that vehicle filter. Paper: as in the paper, frames masked by their occlusion maps, the darkest of them, and the plain adaptive threshold (in the model set the method of the markings too). (vote, darkest, paper)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Method of the markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Resolution of the surface</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>partition: outlines divided among their roofs; points: outlines drawn from the points, then divided; paper: the paper's method in every step.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Georeferenced survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Algorithm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is run on each tile. (buildingsfromals, surfacefromals, roadmarkingsfromorthophoto, groundfrommms, mesh25d, wallsfrommms, orthorectifyframes, aerialmarkings, roadmarkingsfrommms, mergebuildingmodels)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LAS, LAZ or COPC files of the whole area, in any pieces.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outlines of the whole area.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>For road markings: the orthophoto of the whole area.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Settings of the algorithm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines NAME=VALUE, with the algorithm's own names, such as GROUND=ground.tif or MIN_ROOF_AREA=20. An output is made where it is by default, or where a line such as OUTPUT_GROUND=yes asks for it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tile</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side of a tile, whole metres; corners lie on its multiples.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Squares of the side above; or Japan's standard regional meshes (JIS X 0410) of about 1 km, 500 m or 250 m; or the sheets of public survey maps of level 5000 (4 by 3 km), 2500 (2 by 1.5 km), 1000 (800 by 600 m) or 500 (400 by 300 m), in a plane rectangular system. Tiles are then named by their codes. (squares, mesh1km, mesh500m, mesh250m, sheet5000, sheet2500, sheet1000, sheet500)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buffer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Width of the surroundings that a tile reads: more than the largest building, and than the reach of ground under buildings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tiles to try</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Only this many tiles, spread over the area, to say what all will take in time, memory and disk; 0 does all.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tiles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One square a tile with status, reason, time, memory.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder of the run</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Results by tile, merged results, and what a later run needs to go on.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>HTML report: what was done, what failed and why, time, memory, disk, a map of the tiles.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tiles done</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Empty tiles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Failed tiles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tiles kept from an earlier run</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Workflows</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Goes from aerial frames and airborne laser points to the reference that mobile surveys are tied to, in one run: surface and ground from ALS, orthophoto of the ground that the frames see, without moving vehicles, and road markings with their heights.&lt;/p&gt;&lt;p&gt;This is the same chain as “Road markings from aerial frames”, as a model: open it in the modeller to see its steps, or save it under another name and change it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points on road markings that two overlapping images show, with the shift of the second against the first in metres (east, north; sigma of one place), and the median of the pair with its sigma. Pairs that lie more than a pixel apart have the status “apart”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Goes from airborne laser points and rough outlines to closed 3D building models in one run: segment buildings, segment roofs, roof polygons, building models.&lt;/p&gt;&lt;p&gt;This is the same chain as “Buildings from ALS”, as a model: open it in the modeller to see its steps, or save it under another name and change it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Goes from a mobile survey to the same survey lying on the aerial reference, in one run: its road markings by intensity, their registration to the reference markings, and the points as the corrected trajectory places them.&lt;/p&gt;&lt;p&gt;This is the same chain as “Georeference mobile survey”, as a model: open it in the modeller to see its steps, or save it under another name and change it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Goes from reference markings and corrected drives to a lane map, in one run: line work of the markings, then lanes with their bounds, directions and connections, as layers, as Lanelet2 file for Autoware and as OpenDRIVE file.&lt;/p&gt;&lt;p&gt;This is the same chain as “Lane map from markings and drives”, as a model: open it in the modeller to see its steps, or save it under another name and change it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Polygons: class (crosswalk, arrow straight, ..., diamond, unknown), colour, heading (degrees from grid north in which it is read), score (0 to 1: agreement with the shape; of a crosswalk paint at its bars' places less that between them).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>UrbanMap: mobile mapping and 3D city models</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Adjust several drives</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mobile mapping</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MMS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mobile</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>adjustment</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>network</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>tie</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>control</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>trajectory</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>strip</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrects several drives of a mobile survey at once. Road markings that two drives saw, or one drive twice, tie them to each other, and so do facades and road as planes; control points and reference markings place them. All go into one least-squares adjustment, in which each trajectory drifts as GNSS and inertial units do.
Without control points and reference markings the drives agree with each other, but their place is only relative: the result says so.
The corrected trajectories keep the names, formats and epochs of those given; apply them with “Apply corrected trajectory”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> Default: {0}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Input</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Output</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Adjust walls by GNSS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GNSS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GPS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RINEX</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>wall</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>facade</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>parapet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>multipath</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>reflection</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ray tracing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Puts walls of building models where reflected satellite signals say they are: models made from roofs have their walls at the parapets, about a metre off.
The code measurement of a signal that a wall has reflected is too long by twice the distance to the wall times a cosine. Only signals that are blocked for sure and that exactly one wall can have reflected are used; those of a satellite within half a minute count as one. A wall is adjusted if there are enough of them, of several satellites and passes, with one answer. All other walls stay where they are, with the reason. Buildings stay closed: neighbouring edges follow.
Give as many passes as there are: with one or two nothing is moved, about ten are needed for a wall.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road markings from aerial frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>road</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>marking</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>aerial</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>orthophoto</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ALS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>reference</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>workflow</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Goes from aerial frames and airborne laser points to the reference that mobile surveys are tied to, in one run: surface and ground from ALS, orthophoto of the ground that the frames see, without moving vehicles, and road markings with their heights.
Frames, points and outlines must be in one projected coordinate system in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Apply corrected trajectory</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>correction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>georeferencing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LAZ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>images</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Moves the points of a survey, and the poses of its images, from the trajectory with which they were placed to the corrected one.
Only coordinates change: attributes, extra dimensions, header records and the order of the points are kept. Several files are written as one, one after the other. The files may be larger than memory. The GPS times of the points may be seconds of the week or adjusted standard time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>building</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>3D</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>solid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LOD1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>OBJ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Joins roof polygons at their heights to closed solids that stand on the ground.
Each solid is checked: closed, planar, oriented outwards, no self-intersection. Where points are given, every building carries how well its model fits them. A building that cannot be modelled keeps its row, with the reason in words.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings from ALS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lidar</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LOD2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Goes from airborne laser points and rough outlines to closed 3D building models in one run: segment buildings, segment roofs, roof polygons, building models.
The method “paper” runs the paper's way whole: all points in the expanded outlines, the histogram alone, alpha shape and Hough lines, the highest point.
The same chain is there as a model that can be changed in the modeller.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibrate scanners</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>calibration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>boresight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lever arm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>scanner</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrects boresight angles and lever arms of scanners on a vehicle. Small planes of road and walls that two scanners saw, or one scanner in passes of different directions, must coincide; the trajectory of each pass may be off as well.
Drive a street with walls in both directions, correct the trajectories (“Adjust several drives” or “Register mobile survey”) and place the points with them first. A misalignment of the inertial unit that all passes have in common becomes part of the boresight.
What the drives do not determine keeps its value and is called so: heights of lever arms mostly need control points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check accuracy at control points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GCP</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>accuracy</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>residual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>error</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measures how far a mobile survey is off at control points, as it was reported and, where a corrected trajectory is given, as that places it.
The numbers are of the corrected survey where one is given, otherwise of the survey as it is.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check lane map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lane</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>HD map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>vector map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lanelet2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Autoware</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>validation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>check</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Checks any Lanelet2 file (OSM) against the rules of Lanelet2's and Autoware's validators that need no other file, and tells what breaks them, with its place.
Errors hinder a reader or change the map's sense: repeated ids, references to what is not in the file, missing tags, lanelets without one left and one right bound, bounds that cross, regulatory elements that nothing refers to, local coordinates on some nodes only. Warnings: points that fall together, borders that coincide but are two ways, odd widths, stop lines and crosswalks without a rule, lanelets without a next and a previous one, missing heights. Infos: ends of the map, lanelets without a speed limit.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Convert heights</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>geoid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>JGD2011</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>JGD2024</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>orthometric</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ellipsoidal</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>標高</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ジオイド</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>標高改定</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Takes heights of point clouds, a raster or a layer from one height system into another, with a grid that you give: GSI's corrections between JGD2011 and JGD2024, or a geoid model.
The result states its height system, and the change is told: its least, mean and largest. In Japan heights of JGD2024 (since April 2025) differ from JGD2011 by up to +57 and -67 cm; plane coordinates are the same.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export city model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PLATEAU</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cesium</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GeoParquet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LOD</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Writes building models of any step as CityJSON, CityGML (in Japan as PLATEAU lays it out) and 3D Tiles.
Each building has its levels of detail 0 (outline and roof outline), 1.2, 1.3 and 2.2 side by side, parts where they stand alone, all attributes of the layer, and figures: heights of its roofs, volumes, areas, storeys as estimated. A solid that is not closed is kept as surfaces, and the field “problems” says so.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Facade textures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line scanners and line cameras</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>texture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>line camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>image</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>glTF</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>appearance</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Gives the facades of building models the images of line cameras, of aerial frames, or of both.
Every place of a facade takes the image that shows it in most detail among those from which no other building hides it and, where laser points are given, no tree or vehicle. Brightness is evened out between images, and they pass softly into each other. Places that no image shows stay grey; a facade that none shows gets no texture, and the layer of facades says why.
Trajectory, points and building models must fit together: correct the survey first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Aerial reference</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>vehicles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>cars</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>traffic</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>darkest</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Makes one orthophoto without moving vehicles from several of the same ground: where a vehicle stands in one, another shows the road. Vehicles that stand still in all of them stay.
The others are resampled onto the first, also from another coordinate system, and their exposures are evened out. Pixels without data in one are taken from the others.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Georeference mobile survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>registration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Goes from a mobile survey to the same survey lying on the aerial reference, in one run: its road markings by intensity, their registration to the reference markings, and the points as the corrected trajectory places them.
With ground heights the correction is in space; without them heights stay as they are. The reference is what “Road markings from aerial frames” makes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Georeference range scans</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>line scanner</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>laser scanner</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>profile</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>direct georeferencing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>VLMS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Places raw measurements of line scanners in the map with the vehicle's trajectory and the calibration.
Scans are tables with the columns time (s), angle (degrees), range (m) and, if wanted, intensity and scanner: CSV (also .gz), Parquet where pyarrow is installed, or LAS and LAZ with gps_time, point_source_id and the extra dimensions angle and range. The beam at angle a points along (cos a, sin a, 0) in the scanner's axes.
Position and angles of the vehicle are linear between epochs. What was measured outside the trajectory's time or in gaps of it of more than a second is left out and counted. The points keep angle and range.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GNSS reflections</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>NLOS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>satellite</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Traces the observed satellite signals among building models: in line of sight, blocked, or reflected once by a wall.
Each signal becomes a 3D line with its excess path as the model predicts it and the residual of its code measurement, after satellite, atmosphere and receiver clock. Signals that are blocked and received all the same have taken another path; where one wall alone can have reflected them, the residual should be the excess path.
The class of a signal near an edge is not sure, as walls of models stand up to a metre or two off.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground of a mobile survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ground</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>pavement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>cloth</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CSF</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>classification</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tells the ground of a mobile laser survey, roads and pavements alike, from all that stands on it.
A cloth is drawn up against the points from below; points within a threshold of it become class 2. Points of other classes than 0, 1 and 2 keep theirs. All attributes and the order of the points stay.
A street that is driven several times is filtered pass by pass where the points have GPS time, because the passes may lie decimetres apart in height. Small clusters of points below a much denser road (multipath ghosts) are left out. The lowest decimetres of walls and posts count as ground: the threshold cannot tell them. The files may be larger than memory.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Landmark update</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>landmark</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>baseline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Moves a trajectory so that it meets control points: the usual method, to compare “Register mobile survey” with.
The correction at each control point is its true place less its place in the survey. Between control points it is interpolated over time; before the first and after the last it stays as it is. Angles are not touched. The result is good near control points and follows the error of the survey between them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lane map from markings and drives</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>OpenDRIVE</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Goes from reference markings and corrected drives to a lane map, in one run: line work of the markings, then lanes with their bounds, directions and connections, as layers, as Lanelet2 file for Autoware and as OpenDRIVE file.
Markings and ground are what “Road markings from aerial frames” makes; trajectories are what “Georeference mobile survey” makes. What is missing for a lane is a finding with its place: look at them, for no lane is made without evidence.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Load city model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>footprints</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>建築物</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>都市モデル</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Loads buildings of city models as outlines with heights and all attributes, and their solids and surfaces, for the other steps.
CityGML as PLATEAU has it (.gml, .zip or its folder; files of roads and the like are passed over), CityJSON and CityJSONSeq are read, levels of detail 0 to 2. Codes get their meaning where the lists are beside the files. A building whose id is not its own, whose solid is not closed or whose parts cannot be read keeps its row; the field “note” says why. Nothing is read from the network.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Load GSI buildings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GSI</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>FGD</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GML</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>JPGIS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>基盤地図情報</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>国土地理院</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Loads building outlines of the Fundamental Geospatial Data of the Geospatial Information Authority of Japan (GSI) as footprints for the other steps.
Areas (BldA) and outlines (BldL) are read from the files as downloaded: .xml, .zip, or a folder of them. Outlines become polygons where they close; a building that several map sheets hold, or that is there both as an area and as an outline, comes once. What is left out or changed is told in the log.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Load GSI elevation model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>DEM</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>elevation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>数値標高モデル</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Loads elevation models of the Fundamental Geospatial Data of the Geospatial Information Authority of Japan (GSI) as a raster of the ground for the other steps.
DEM1A, 5A, 5B, 5C, 10A and 10B are read as downloaded: .xml, .zip (zips in it too), or a folder of them. The newest file of a mesh is taken; where finer products have no height, coarser ones fill in. The raster states its height system (JGD2000, JGD2011 or JGD2024).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Map of localisation accuracy</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>localization</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>localisation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>NDT</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ICP</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>map matching</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>reliability</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>automated driving</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>covariance</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>DOP</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tells from the map alone where a vehicle will know its place, before anyone drives: standard deviations along and across the road and of the heading, by laser scans matched to walls, by road markings, by satellites, and together.
What matters most is how accurately walls and markings stand in the map: give their sigmas. A wall that is displaced displaces the vehicle however many points it gives.
Places that look alike within the search distance are told with their distance and their share of the probability. A place of which the map tells nothing has no sigma and a status with the reason; a direction of which it tells nothing keeps the sigma from before matching.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines from road markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>line</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>dashed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>crosswalk</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>stop line</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>arrow</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lane map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turns polygons of road markings into line work: centre lines with kind, width, colour and sigma, stop lines, crosswalks, and symbols such as arrows and diamonds.
Pieces of paint that continue each other become one line, also across the gaps of dashes, of wear and of vehicles; how much was bridged is a field. A line is dashed where a periodic pattern explains its paint better than a solid line; begins and ends of the dashes are a field. Centre lines are fitted to cross-sections of the paint and smoothed over 3 m.
Arrows are told by their shape, and only where one shape is clearly better than the others. Paint that is neither line nor known shape keeps its polygon, with the class unknown.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Merge building models with measured walls</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>merge</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Joins building models from airborne scanning with walls measured from the street: below a height the walls lie where the survey found them, above it the models stay as they were.
Walls move within stated limits and never into a neighbour. A roof that stands out over the measured wall stays, with a level underside; so does what stands out at the height. Walls that were not driven past stay and are marked.
Every result is checked: closed, planar, oriented outwards, no self-intersection. A building that cannot be merged keeps its model and says why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>2.5D mesh of buildings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mesh</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>2.5D</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>TIN</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>curved</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>complex</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PLY</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Makes closed meshes of complex or curved buildings from their points: triangulated roofs, upright walls where the heights step, a level ground.
The mesh is simplified as far as the stated error allows: at least 95 % of a building's uppermost points shall lie within it. Where that cannot be reached, as with what stands on roofs, the building says so; so it does of a second surface under the first, which has no place in a 2.5D mesh.
Points with building_id are taken by their number; from others the outlines cut their points, of classified ones those of class 6.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Objects from images</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>sign</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>signal</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>light</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>kerb</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>object</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>laser</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Brings outlines that were drawn on line images or frames into the map: sign boards, signals and lights as polygons or points, kerbs as lines.
Laser points are projected into the image; those inside the outline and on the nearest connected surface give the outline its place, size, orientation and height. All fields of the outlines are kept.
Open the image in QGIS without a coordinate reference system and draw on it: x runs along the columns, y is negative downwards. A field image names the file where there are several.
Images and points must be placed by the same trajectory.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Occlusion map of a frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>perspective occlusion map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>POM</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>relief displacement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>building lean</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>visibility</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mask</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>photograph</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Masks the pixels of an aerial frame that show a building or the ground that a building hides.
The surface that is higher above the ground than the threshold is projected into the frame with its camera and exterior orientation, lens distortion included, and filled, walls too. Trees and bridges as high as that are masked as well.
The edges are as good as the surface: use a resolution near the distance between the laser points. Building outlines add low buildings and roofs with missing points. The mask has the rows and columns of the frame and no place in the world.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Orthorectify frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>orthorectification</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>true ortho</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mosaic</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lays aerial frames on the ground as one mosaic. Ground that a building, tree or bridge hides from one frame is taken from another that sees it; buildings themselves and ground that no frame sees hold no data (0).
Differences in exposure between frames are evened out first. With the vehicle filter moving vehicles go, because another frame shows the road where they stood; vehicles that stand still in all frames stay.
Frames, ground and surface must be in one projected coordinate system in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Overlay on images</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>overlay</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>building frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>after</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draws laser points and the edges of building models or other lines on line images, frames and orthophotos, so that one sees whether they fit.
Edges that a building hides are left out, and points behind a nearer surface. With what was before a correction (trajectory, points, lines) each picture is made twice, and the page switches between them.
Points are read once; each image keeps the nearest point of every 3 by 3 pixels.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rectify trajectory</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>tie points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>drift</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>INS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrects position and heading of a survey's trajectory by tie points: places, such as corners of buildings, that the survey and a reference both show. Two or more pairs measured within some seconds are a set.
By default the drift is estimated from all tie points together, each at its own time, with its sigma at every epoch; contradicting pairs and sets are found and told. In the methods “relative” and “iterative” each set gives a true pose, and the relative motions between two of them take their parts of the error, in closed form or by the paper's iteration. “paper” follows the paper to the letter: the first two pairs of each set, its equations 8, 9 and 13 to 17, equally sampled heights, and nothing left out as wrong. Before the first and after the last set the correction is carried on, and its sigma grows.
With a ground raster the heights then follow the ground along the course, at the given height of the trajectory's origin above it. Roll and pitch stay as they are.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Register mobile survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Finds how the trajectory of a mobile survey is off, by laying its road markings on those of an aerial reference, and corrects it.
The driven path is cut into short patches; each is registered with a window of patches round it that is as long as its markings need. The windows' results become one smooth correction over the path: stretches that contradict the rest lose their weight, gaps are bridged with growing uncertainty, and each patch says how its correction was found and how sure it is.
With ground heights (a raster, or polygons with heights) the correction is in space; without them heights, roll and pitch stay as they are. Apply the result with “Apply corrected trajectory”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>curb</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>edge</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>border</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>guard rail</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>breakline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Finds kerbs, lowered kerbs, road borders without kerb, guard rails and walls along the drive of a corrected mobile survey, as lines with heights, standard deviations and the share of their length that was measured.
Kerbs are steps between two smooth sides. Each half metre a profile across the edge gives its foot, top and face; passes through the same place are fitted apart and combined by their sigma. Where neither side is seen, as behind parked cars, a line ends: “gap” tells how far the next part of its chain is away, nothing is drawn in between.
A kerb whose face is not seen, and rails that may be the sides of vehicles, are doubtful, with the reason. Points and trajectory must be corrected ones: lines are as wrong as the survey is.
Objects of “Objects from images” and walls of “Walls of the mobile survey” can be put into one GeoPackage with the edges.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road markings of a mobile survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>paint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>intensity</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>reflectance</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>threshold</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Takes the points on road markings out of a mobile laser survey by their intensity.
Intensity falls with range and incidence: asphalt's is fitted as a curve over range for each scanner, and all intensities are divided by it. Points brighter than the ground round them are marking points, if they form strokes; kerbs, feet of walls and wide bright surfaces are left out.
Ground is taken by class 2 where at least 1 % of the points have it, otherwise found by the cloth filter. The survey is worked on along the path: passes through the same place are not mixed, and what was measured while the vehicle stood for more than a second is left out. The files may be larger than memory.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road markings from orthophoto</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>zebra</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>crossing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>adaptive threshold</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Finds painted road markings, white, yellow and blue, in an orthophoto: a mask on the orthophoto's pixels and polygons whose outlines are finer than the pixels.
After a level adjustment, pixels are kept that are brighter by the contrast than the Gaussian mean of the block round them (in shade in proportion less). Then goes what is no paint: what is as bright on one side (kerbs, walls, edges of shadows), bright bodies wider than paint (vehicles, roofs) and short pieces at them, leaves, specks, and roof edges along what is hidden. The ground beside must be smooth and grey as roads are: a confidence tells how much it is.
Any orthophoto of 0.5 m or finer will do, in grey or in red, green and blue, 8 or 16 bit, of any size. Give roads where you have them: bright lines on roofs, plots and paving are then left out. Give building outlines, or the mask of what buildings hide, where they lean in the image.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>roof</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>polygon</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>alpha shape</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hough</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>outline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draws the polygon of each roof from its points.
The method “partition” divides each outline among its roofs along straight lines where roofs meet: no gaps, no slivers, common edges. The method “points” first draws the building's outer limit from its points, for outlines that are wrong in shape, then divides it likewise. The method “paper” outlines each roof on its own: radius outlier removal, alpha shape, Hough lines over the ordered boundary points, and the polygon from these lines, at the height of the roof's highest point; it leaves the outline aside and needs roofs of simple shape. A building without a roof then has no polygon; the other methods give it a plain block.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Getting started</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>sample</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>example</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>demo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>test data</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>simulation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>synthetic</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>tutorial</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Makes a city block that does not exist, with all the data that UrbanMap works on and the truth to check the results against: aerial frames, airborne laser points, official outlines, two mobile surveys that are about a metre off, line scans, GNSS observations.
Begin here without data of your own: every algorithm can be tried on the files in the folder, which are in UrbanMap's own formats. A README.txt in the folder says what is where. The default city takes about a minute and 60 MB.
The same seed, size and scene give the same files.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Satellite visibility</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>line of sight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LOS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PDOP</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>sky</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>planning</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Counts the navigation satellites in line of sight among building models: along a trajectory, or over an area at a given time.
Fewer than four satellites of one system do not give a position; with each further system one more is needed for its clock (QZSS keeps that of GPS). The PDOP tells how much larger the error of a position is than that of a range; it is empty where the satellites in line of sight fix no position.
Walls hide satellites; trees, vehicles and bridges do not. Where walls of the models stand a metre off, satellites near their edges are counted wrongly.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Segment buildings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>footprint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>segmentation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Takes the laser points of each building out of a point cloud, with the help of rough outlines.
Each outline is first moved to where the points show its building, then expanded, and takes the points inside. Where expanded outlines overlap, a point goes to the building whose own surface is nearest to it. Points of class 6 are used where the cloud is classified; elsewhere what stands high above the ground.
The outlines in the result carry what was found: points, density, ground height, displacement and its standard deviation. A building without points keeps its row and says so.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Segment roofs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>histogram</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Segments the roofs of each building: planes, level and sloped, grown on its points; or level roofs by the histogram of its points' heights.
The histogram has overlapping bins. Each maximum with more points than the minimum roof area holds is a roof; a parapet's maximum is joined with its roof's. Beyond the paper, one maximum that is two roofs apart in plan becomes two, small roofs that stand out are kept, and sloped roofs become a few level ones, as finely as the height error asks.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Surface and ground from ALS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>DSM</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>DTM</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>surface</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>terrain</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Delaunay</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Makes the surface (DSM) and the ground elevation of a laser point cloud as rasters.
The surface is the 2.5D Delaunay triangulation of the highest point of each cell. The ground is the triangulation of the ground points, which also spans buildings: it has no gap under them. Ground points are those classified so (classes 2, 8, 10, 11; not water) or, where the cloud is unclassified, those that a cloth drawn up from below touches.
Noise (classes 7 and 18), withheld points and points alone in space are left out. The files may be larger than memory. Cells without a height hold -9999.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Propose tie points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>corners</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>buildings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>walls</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>rectification</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Proposes tie points for “Rectify trajectory”: corners of buildings that the survey and the outlines both show.
Where points of the survey stand over each other there are walls; the two walls of each corner are looked for along the outline's edges, and meet in the survey's corner. Of several possible places the one is taken that is shifted like the corners measured about the same time. Corners are gathered in sets of two.
Each line of the result runs from the survey to the reference. Look at them before they are used: delete wrong ones, move ends, add others. They are as good as the outlines: give the outlines' accuracy as “Sigma of tie points” to the rectification.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Run over tiles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>tile</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>batch</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>grid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>large area</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>resume</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>overnight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>scale</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Runs another algorithm over an area of any size, tile by tile: each tile reads its part of the inputs with a buffer around it, and keeps what is its own of the results, so that a building on an edge is there once.
Each tile is whole or not there. Run again with the same folder, settings and inputs, it goes on where it was ended; tiles that failed, or whose inputs changed, are done again. One failed tile does not end the run.
The algorithm's parameters are given as lines NAME=VALUE, on the command line also by themselves. Point clouds, rasters and layers among them are cut; everything else is the same for all tiles. Layers and rasters are put together in the folder “merged”, point clouds stay by tile.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lane map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Makes lanes of line work and drives: bounds shared with the lanes beside, centre lines, width, direction, successors, neighbours, stop lines and crosswalks; as layers, as Lanelet2 file with the tags that Autoware expects, and as OpenDRIVE file.
Lines side by side are a road section. A lane is made between two lines at a lane's width, where a drive, an arrow or a stop line shows its direction, or a lane across a dashed line or across a yellow or double centre line does. Nothing else becomes a lane: strips without evidence, open ends, bounds that were not seen and ways that were driven outside all lanes are findings with a place.
Through junctions a virtual lane is made where a drive shows it. Traffic keeps to the side that the drives show, unless it is given. Trajectories must be corrected ones: an error of a metre puts a drive into the wrong lane.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls from a mobile survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mobile mapping</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>plane</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>contour</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Finds the walls of buildings in a mobile survey that has been put on the map.
Points near the buildings' outlines and below a height above ground are separated into walls and the rest by their normals, freed of outliers and cut into planes. The alpha shape of each plane's points is the contour of a wall; holes in it are places where nothing was measured, such as windows, passages and shadows.
Each wall says how well its points fit, how well its place is known, how much of it was seen and how much may be hidden behind trees, vehicles and the like. The accuracy is that of the wall in the survey; the place of the survey itself is not in it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} holds no camera: it must be a JSON object with focal_length_mm and so on.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>principal_point_mm in {path} must be two numbers: x0 and y0 in millimetres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is missing in {path} or is not a number: add it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The distortion in {path} is not of the model "brown": convert it, or resample the frames without distortion.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The distortion in {path} must name its units: "mm" or "focal".</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The angles are in degrees, gon or radians and in the order papers or usual, not {unit} and {order}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has no column {missing}: its first line must be {columns}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} lists no image.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} holds a value that is not a number for {names}: correct it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The angles in {path} look like {guess}: convert them to degrees, or say their unit if you know it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera's focal length, pixel pitch, width and height must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line {line_num} of {path} names no image or one that came before: each image needs one line.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line {line_num} of {path} ({name}) must hold numbers in x, y, z, omega, phi, kappa.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{first} and {second} lie {unexplained:.2f} m apart on the road markings {value}(east {east:.2f}, north {north:.2f}, sigma {unexplained_2:.2f}; {patches} places): check their orientation and the ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{bad_count} more pairs of images lie apart.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In {hidden} pairs of images the shift may come from the height of what stands on the ground: a surface (DSM) would tell, here only shifts across their base were checked.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>across their base </source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The frame {twice} is given twice: name each once.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Images of the exterior orientation are not in {folder}: {missing}{more}; copy them there, or choose the frames one by one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The exterior orientation has no line for {given}: add it, or leave the frame out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be read as an image: check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is damaged: {error}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has a colour table: convert it to red, green and blue first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} holds complex numbers, no image: give an orthophoto.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has no image bands: give an orthophoto in grey or in red, green and blue.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} says where it lies in numbers that are not finite: it is damaged; export it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has pixels that are not square: warp it to square pixels first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has pixels of {own_pixel:.2f} m, in which road markings cannot be seen: use an orthophoto of {max_pixel} m or finer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} does not reach {path_2}: give a mask of the same place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{mask} does not cover all of {path}: where it does not, nothing is taken as hidden.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be read as a raster: check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{output} cannot be written ({error}): choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No two frames share enough markings to be compared: a wrong orientation would not show.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>With pixels of {pixel:.2f} m lane lines are narrower than a pixel: many are missed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No roads were given: edges of flat roofs, kerbs, rims of vehicles, reeds at water and lines of car parks may be among the markings; cut by their confidence, or give roads.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No marking was found: check the roads, the contrast and whether the image shows any.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{polygons_count} markings were found. </source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{doubts_count} things are to be looked at first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No frame shows any of the ground: check that frames, exterior orientation and ground lie in the same place and coordinate system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The images hold {dtype} numbers: convert them to 8 or 16 bit without sign.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No frame sees any ground there: check that frames, exterior orientation, ground and surface lie in the same place and coordinate system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The coordinate reference system cannot be understood: set another one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{image} cannot be written ({error}): choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{image} looks past the surface and ground rasters: choose rasters of its place, and check that heights, CRS and angles fit.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The height threshold must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{uncovered:.0%} of {image} looks beyond the surface or the ground raster: buildings there are not masked.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} holds no heights: check the raster.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Occlusion maps of the frames need a surface (DSM): give one, or give the maps themselves.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The frames lie below the ground: check the heights in the exterior orientation.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{beside_count} frames show none of the ground and are left out: {beside}{value}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Without a surface (DSM) buildings cannot be told to hide the ground: they lie over it in the mosaic.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The surface (DSM) does not cover the whole mosaic: beyond it buildings lie over the ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has {kind} bands of {kind_2} but {path_2} {kinds} of {kinds_2}: give frames of one kind.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> and others</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Levels are four numbers, low, high, middle and noise, the second above the first: give those, or none.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} says where it lies in numbers that are not finite: it is damaged; export it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is turned or its pixels are not square: warp it to a north-up raster first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Vehicles can only be told by comparing: give two or more orthophotos of the same ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has no coordinate reference system: set it first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} has {bands} bands of {dtype} but {first} {bands_2} of {dtype_2}: give orthophotos of one kind.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No two of the orthophotos show the same ground: no vehicle was filtered.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is damaged: {error}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} cannot be read as an image: check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{paths} has no attribute {name}: run “{maker}” first and give its result.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A part of the model has no height: give finite heights.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The model has no parts.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The model has no part with a volume.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Two buildings have the same building_id: give each building its own.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There are no measured walls: run “Walls from a mobile survey” first and check that it found any.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Building {flat} has no heights: give building models (MultiPolygonZ), not outlines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No measured wall lies near any model: check that both are of the same place, and that the survey has been put on the map.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the plan would fold over itself</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{fspath} holds no building: give a CityJSON file with buildings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height, maximum offset and rotation (up to 20 degrees) and the share of a wall must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>only {points_count} points lie in it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>none of its points lies on its outline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No point lies in any outline: check that both are of the same place and CRS.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The maximum error and the height step must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>its outline has no area</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No roof has a building_id that the outlines have: give the outlines that the roofs were made with.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The worst {worst_count}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The building evidence does not lie on its grid: give both the same rows and columns.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The longest shift of an outline must be at least {coarse_step} m.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The point density is not a positive number: check that the points cover the outlines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The ground heights do not lie on the grid of the evidence: give both the same grid.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The layer of building outlines is empty: give a layer with polygons.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No building outline has a usable polygon: check the outlines' geometries.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Some building_id of the outlines is empty or no whole number: number the outlines or remove the field.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Some building_id of the outlines is below 1 or too large: number the outlines from 1 or remove the field.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The outlines hold the building_id {unique} more than once: make it unique or remove the field.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A detected line needs at least three boundary points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The distance of boundary points to their line must be above zero metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The point density must be above zero points per square metre.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The building's points are too few to draw an outline from them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The building's points lie on its neighbours: check the building outlines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The outlier radius must be above zero metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>An outline needs at least four boundary points to be regularised.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The roof raster has not the rows and columns of its grid.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At most {max_lines} dividing lines are possible: lower their number.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The building outline has no area: repair or remove it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A roof polygon needs at least three edges: lower the least number of edge points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The bin width and the bin shift of the height histogram must be more than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Some point heights are not numbers: remove these points first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The heights of a building's points span too many bins: remove outliers first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The x, y and z of a building's points differ in number.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The return numbers and the coordinates of a building's points differ in number.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Some coordinates of a building's points are not numbers: remove them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A building's ground height and point density must be numbers, density above 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No sound point lies near any outline: check that points and outlines are of the same place, and that coordinates and heights are in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The point cloud and the outlines do not overlap: check that both are of the same place and that their coordinate reference systems are set right.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No roof lies on the plan of the building: check outline and roofs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The plan's limit is '{limit}': give 'footprint' or 'roofs'.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The plan's limit is the footprint, but there is none: give one, or limit to the roofs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Roof polygons, heights and ids differ in number: give one height and id for each roof.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The building has no roof: give at least one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A roof has no height: give a finite height for each roof.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The building has no base height: give the ground's height in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cells of one building overlap: cut its plan with partition_plan first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Face {face} {text}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>An edge belongs to one face only: the shell has a hole.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Faces touch each other only in this point.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The solid has no faces.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A face of the solid names a vertex that does not exist: the model is damaged.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A vertex of the solid is not a finite number: the model is damaged.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A face of the solid has an empty ring: the model is damaged.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Face {face_of} repeats a point.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Face {face} has a point {off:.4f} m off its plane.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The shell has {face_count} faces: the least is 4.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Face {face_of} and its neighbour turn opposite ways at their edge.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>An edge of face {owners} runs into face {face}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The faces look inwards.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A ring of face {face_of} visits a point twice.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityGML states heights in JGD2011 (EPSG:6697), but those of the models are {heights}: give the height system, or convert the heights, if they are others.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>3D Tiles want heights above the ellipsoid, but those of the models are {known} and are written as they are: give a geoid model, or buildings sink or float on a globe.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{missing} buildings have no model and no place in a mesh: CityGML leaves them out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The city models are in different reference systems: load them in separate runs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The city model holds no building: give one that has buildings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The city model was taken into another datum by {told}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The city model is in degrees outside of Japan: choose a projected coordinate reference system in metres for the result.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No building of the city model has a geometry: give one with outlines or solids.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} names no coordinate reference system: give the one that it is in.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>City objects that are no buildings were passed over ({counts}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Parts of buildings that have no place in the result were left out ({counts}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} is no CityGML (its root is {split_tag}): give a city model.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} is in another reference system than {sources}: load them in separate runs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {target} cannot be made ({strerror}): choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {folder} holds CityGML of another program ({path}): choose another folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The image {image} of a texture was not given: its file is missing.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The image {place} cannot be written ({strerror}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is not a CityJSON file: its type is not 'CityJSON'.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is damaged: its line {number} is no object; export it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is damaged: its line {number} is no JSON; export it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} names no coordinate reference system: give the one that it is in.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is damaged: it has no city objects; export it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is damaged: its vertex {bad} has no finite coordinates.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is damaged: a ring is no list of vertices; export it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is damaged: it names a vertex that it does not have; export it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CityJSON is written in metres, but the model counts in degrees: take it into a plane reference system first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Two buildings have the id '{id}': give each building its own.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {place} cannot be made ({strerror}): choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has no textures: give the CityJSON file that “Facade textures” wrote.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} names the image {name}, which is not in its own folder: move it there.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The image {parent} cannot be written ({strerror}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{where}: the coordinate reference system {name} is not known; give the one that it is in.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The coordinate reference system has no horizontal part: choose another.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{where}: the coordinate reference system EPSG:{code} is not known here; give the one that it is in.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The code {code} is none of a municipality: give its five digits, such as 13101.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The models state heights in {stated}, not in {given}: convert them first, or leave the height system out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The image {look} of a texture was not given: its file is missing.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {folder} holds a tileset of another program: choose another folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>3D Tiles need a place on the earth: the models' coordinate reference system is not known.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Python {noun} in the way: {names}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{python} has no pip, which installs Python packages: {advice}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>pip could not install the packages: {value}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Python cannot be started as {command} ({strerror}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The memory is not enough for this run: give less data at a time, or a coarser resolution.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The disk is full: make room on the disk of the outputs and of temporary files, and run again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No building has a polygon: choose a layer of outlines or building models.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The height must be greater than 0 and the tolerance of the outlines between 0 and 10 m.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No point of the survey lies near a building: check that both are of the same place and CRS, and that the survey has been put on the map.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outliers need at least one neighbour and a number of deviations above 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The minimum area of a wall must be greater than 0, the minimum opening and alpha and gap not below.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tolerance and minimum area of walls must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Building {ids}: only {kept_share:.0f} % of its points were used, as there are more than fit into memory.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>An alpha shape needs points with two coordinates.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Alpha must be above zero metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The raster's extent or cell size is not a number: check the coordinates.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The place {latitude:.5f}, {longitude:.5f} has no mesh code: it is not in Japan.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{crs} is not a projected CRS in metres: reproject the data.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The trajectory lies outside the area of its CRS: check the CRS.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The CRS of the map is not known: give the data a projected CRS in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No navigation file is given: give the satellites' navigation files of the day.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is not an SP3 file of version c or d: check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} counts time in "{scale}", which is not known: use orbits in GPS time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: {where} is not finite; download the file again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} holds no satellite position: the file is not whole.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no observation to trace: check that observations, ephemerides and trajectory belong to the same time and place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All places of the antenna lie within buildings: check the coordinate systems and heights of the trajectory and of the buildings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At {sum} of {indoors_count} epochs the antenna lies within a building: their signals are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The maximum range must be greater than 0, margins and angles not less than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No cell of the area has a ground height: give a ground that covers it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The whole area lies inside buildings: choose a larger area or finer cells.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The buildings do not tell the height of the ground: give a ground raster.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No satellite of the chosen systems ({chosen}) can be placed at {calendar_text} GPS time; the navigation files are good for {spans_text}: give those of the day.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The area has {cells:.1f} million cells of {resolution:g} m: choose a coarser resolution or a smaller area.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>"{text}" is no time: write it as 2024-04-18 02:30:00, in UTC.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{without} of {shapes_count} buildings have no heights: give solids, outlines with z, or the field with the height of their tops.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The buildings have no walls: give solids or outlines with heights.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} holds no solids: give building models of LoD 1 or higher.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} of {kind_count} signals are reflected by one wall; of {sure:.0f} % of all signals the class is sure.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{sum} of {adjusted_count} walls are adjusted, with a median standard deviation of {median:.2f} m. The others stay where they were: nothing is known of them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{order_count} more are in the layer of walls.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The geoid separation was estimated from the satellites ({geoid_separation:.1f} m, sigma {geoid_sigma:.1f} m). An error of it is mostly taken up by the clock.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residuals of signals {names} ({sum:,}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} holds observations: give a navigation file here.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} is a RINEX file but no navigation file: give one of type N.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} holds no record of a satellite that can be used: give another navigation file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} is a RINEX file but holds no observations: give it as another parameter.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} holds no code observation of the chosen systems: check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} counts time in "{scale}", which is not known: convert it to GPS time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} does not tell its types of observations: its header is not whole.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} holds no epoch with observations: check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} has a scale factor that cannot be read: check its header.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is packed in a way that is not read here: unpack it, or pack it with gzip.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is empty: choose another file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is compact (Hatanaka) RINEX: convert it to plain RINEX with CRX2RNX first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is not a RINEX file: its first line does not say "RINEX VERSION / TYPE".</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is RINEX {version:.2f}: convert it to RINEX 2.11 or 3.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has no "END OF HEADER": the file is not whole.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be read ({strerror}): check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} tells no RINEX version in its first line: check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} holds more than {largest} MB when unpacked: give the files of one drive at a time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is not a sound gzip file: fetch it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Too few satellites at different elevations tell the height of the antenna: give the geoid separation.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Trajectory and {what} are not of one time: the trajectory covers {told}, the {what} cover {span_text} GPS time ({start:.0f} to {end:.0f} s of week).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The geoid separation was not given; the satellites say {offset:.1f} m (sigma {sigma:.1f} m), which is used: the official value is better.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The strongest signals contradict each other by {scatter:.1f} m at the places of the trajectory, more than the 1 to 3 m that are usual: check its times, its places and the lever arm of the antenna.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No observation file is given: give the receiver's RINEX observation files.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No observation can be used ({value}): check that observations, navigation and trajectory belong together.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The navigation files tell no coefficients of the ionosphere: its delay, some metres, is not taken off; give a navigation file of GPS.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Precise orbits alone tell no group delays, up to some metres: they are not taken off; give the navigation files too.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No satellite of {system_names} can be placed: its signals are left out; give its navigation file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>By the satellites the antenna is {offset:.0f} m {value} than the trajectory with a geoid separation of {given:g} m says: heights above sea level and above the ellipsoid seem to be mixed up; a separation of about {given_2:.0f} m would fit.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The code ranges do not fit the trajectory (the strongest signals contradict each other by {scatter:.0f} m): its CRS, its times or the observation file are of another drive.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} was observed {observed} GPS time, but the navigation files are good for {good}: give those of the same day.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Satellites that {why} are left out: {names}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>By the satellites the antenna is {offset:.0f} m above the heights of the trajectory, more than any geoid separation: trajectory and observations do not belong together.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The trajectory's times are {leap:.0f} s {fault}: give them in GPS time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>higher</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lower</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{who} overlap in time: give times that count on over the weeks (full GPS seconds), or each place of the vehicle once.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is of the time of none of the trajectories: give the trajectory of that drive, or leave the file out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} may belong to {who}, which have the same times of the week: give trajectories in full GPS seconds.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Prior, block length, maximum sigma, maximum offset and iterations must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The minimum numbers of observations, satellites and passes must be at least 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At no epoch are three satellites in line of sight, so that the receiver's clock is not known: give observations of more satellites, or check heights and coordinate systems.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The models or lines have no heights, without which they have no place in an image: give models or lines with heights (for lines: QGIS's “Drape”).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outline {number} was drawn on {name}, which was not given (images: {known}): add the image or correct the field “image”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No outline was drawn: draw polygons, lines or points on the images first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outline {number} does not say on which of the {sources_count} images it was drawn: fill the field “image” with the file's name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outline {number} lies outside {source} ({columns} x {rows} pixels): draw it on the image without a coordinate reference system, where y is negative.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Edges should run along what the images show, and points lie on what they were measured from; where they do not, survey, orientation or models are off.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source}, columns {left} to {right}, rows {top} to {bottom}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing lies in any of the images: check that images, trajectory, points and lines are of one place, in one coordinate system, and heights in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{target} cannot be written ({strerror}): choose another folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The textured model {path} must end in .glb, .obj or .city.json.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {folder} cannot be made ({strerror}): choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{target} cannot be written ({strerror}): choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no building model to texture: check the layer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Building {number} has no heights: give building models (MultiPolygonZ), such as those of “Building models”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The strip image {name} was taken from {times:.1f} to {times_2:.1f} s, the trajectory runs from {time:.1f} to {time_2:.1f} s: give those of one survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {final_text} does not exist: create it or choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {final_text} cannot be written: choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{shown} is a folder: give the name of a file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{shown} cannot be the name of a file ({strerror}): choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{shown} cannot be written ({strerror}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{shown} cannot be written: make room on its disk, or choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{shown} cannot be replaced ({strerror}): close the program that has it open.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is damaged: a city object or its vertices cannot be understood.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is damaged: an attribute of {key} is no finite number.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The coordinate reference system is no WKT that can be understood: set another one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The coordinate reference system is cut off: set another one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is no geoid model: its values must be heights of the geoid above the ellipsoid in metres, none beyond {highest:g}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is no geoid model: its cells must lie along latitude and longitude in degrees.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} holds {values_count} heights, its header says {rows}: the file is cut off; download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} does not reach latitude {flat:.4f}, longitude {flat_2:.4f}: give the geoid model of the survey's place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be read as a geoid model: give a GeoTIFF, a GTX or a text grid of GSI.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The model file {path} needs a name that ends in .glb.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The image {key} of a texture was not given.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>None of the buildings in {first} has a usable outline: {some}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The outlines are in JGD2000 and were taken into {target} without the movements of the ground in 2011, up to 5 m in north-east Japan: correct them there with PatchJGD.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No outline in {source} closes to a polygon: give all map sheets around the area, or BldA files.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The reference system {unknown} of the outlines is not known: give data in JGD2000, JGD2011 or JGD2024 (latitude and longitude).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Some outlines are in JGD2000 and others in JGD2011 or JGD2024, which lie up to 5 m apart: load them in separate runs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The outlines name no reference system; JGD2011 was taken.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>JGD2024 was taken as JGD2011 (EPSG:6668): their horizontal coordinates are the same.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Objects that are no building outlines were passed over ({kinds}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The buildings cannot be turned into {target}: choose a reference system made for Japan.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The reference system {crs} is not known: choose another.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source}: cells of {cell:.3f} seconds are of no elevation model of the GSI; give {what} as they were downloaded.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{strange} is no elevation model of the GSI: give {what} as they were downloaded.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Some meshes are in {systems} and others in {systems_2}, whose heights differ by up to decimetres: load them in separate runs and convert one with “Convert heights”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} is damaged: its elevation model has no coverage; download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} is damaged: its grid of {columns} x {rows} cells cannot be; download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} is damaged: its cells are not as high as wide; download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source}: the reference system {value} is not known: give data in JGD2000, JGD2011 or JGD2024.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} is damaged: {name} does not hold two numbers; download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source}: its cells are in an order ({order}) that is not known; download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} is damaged: it has more heights than its {columns} x {rows} cells from its start point on; download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} is damaged: {line!r} is no kind with a height; download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} is damaged: a height is no number; download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The raster would have {columns} x {rows} cells: load fewer meshes at a time, or choose a coarser resolution.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The elevation model lies outside of where the reference system can be computed: choose one made for Japan.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} is not whole, valid XML (line {line}, column {column}): download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} has an object of more than {largest_object} MB, which no building is: download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No file was given: choose {what} ({suffixes}, .zip or a folder of them).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{given} holds no {what} but {others}: {advice}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} does not exist: check the path.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is a zip nested more than {deepest_zip} deep: unpack it first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} holds no {suffixes} file: give {what} as they were downloaded.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{label} is encrypted: unpack it with its password and give the files in it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{label} would unpack to {file_size} GB from {compress_size} MB, which no map data does: get the file again from where it comes from.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{label} holds more than {largest_zip} GB: unpack it first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is damaged or not a zip file ({error}): download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} cannot be unpacked here ({error}): unpack it and give the files in it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} cannot be read ({value}): check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} cannot be read as {what}{reason}: it is damaged or of another kind; export or download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be read as {what}{reason}: it is not JSON, or damaged; export it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The data say that their heights are in {own}, not in {stated}: leave the system of the data empty.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The data do not say what their heights count from: give the height system that they are in.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The height system of the result is not known: give JGD2000, JGD2011, JGD2024, ellipsoidal or an EPSG code.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The heights are in {source} already: there is nothing to convert.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The data have no coordinate reference system: assign the one that they are in.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} holds no heights: give another raster.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{grid} holds at most {size:.2f} m, which are corrections: between ellipsoidal heights and those above the geoid give a geoid model.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{grid} holds up to {size:.1f} m, which is a geoid model: between {source} and {target} give the grid of corrections.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The height system {word} is not known: give JGD2000, JGD2011, JGD2024, ellipsoidal or the EPSG code of a vertical reference system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{label_a} has heights in {first}, but {label_b} in {second}: convert one of them with “Convert heights” and the correction or geoid grid for it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be read ({strerror}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be read as LAS or LAZ ({reason}): copy or download it again, or convert it if it is of another kind.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is damaged: copy or download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The mesh file {target} needs a name that ends in .obj.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is no OSM file: its outermost element is {tag}, not osm.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No point cloud was given: choose one or several LAS or LAZ files.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{files} holds no points: choose another point cloud.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{files} has coordinates that are not numbers: repair the file's header.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The point cloud {path} does not exist.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} must end in .laz or .las.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is in {crs}, but {stated} is in {stated_2}: give files of one coordinate reference system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be read as LAS or LAZ ({error}): it may be truncated or of another kind.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The coordinate reference system in {path} cannot be understood: set it right in the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is truncated: it holds {read:,} of {point_count:,} points; copy or download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is damaged or truncated after {read:,} of {point_count:,} points: copy or download it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is turned or its cells are not square: warp it to a north-up raster first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be written ({error}): choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has {bands} bands, no band {band}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Made by</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Day</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{caption} ({missing} without a value)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How this was made</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is no PNG or JPEG picture: a report can hold only these.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Settings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>yes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From {source} to {target} no transformation of {rough:g} m or better is known here: transform the data first, between Japan's datums with GSI's TKY2JGD or PatchJGD.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A coordinate reference system has no horizontal part: set another one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be taken to where the other data lie: check the coordinate reference systems.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Some places lie outside of where the reference system can be computed: check the coordinate reference systems.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A coordinate reference system cannot be understood: set another one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The reference system EPSG:{code} is not known here: choose another.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{target} is a folder; give the name of a file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{target} is no plain file; give another name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{target} is open in another program, or is edited in this one; close it there, or choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {folder} does not exist; create it or choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {folder} cannot be written; choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{target} cannot be the name of a file ({reason}); choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {folder} cannot be written ({strerror}): choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{final_text} cannot be replaced ({strerror}): close the program that has it open, or choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} declares the unknown encoding {encoding}: save it as UTF-8.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} is not whole, valid XML (line {line}, column {column}): get the file again from where it comes from.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} holds bytes that are not valid {encoding}: download it again or correct its declared encoding.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has no object in its first {longest_prolog} MB: get the file again from where it comes from.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has a document type declaration, which {maker} never has and which may be harmful: get the file again from where it comes from.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{source} has an object of more than {largest} MB: get the file again from where it comes from.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>On {mean:.0%} of the places the map tells where a vehicle is, with a median sigma of {median:.2f} m in the weakest direction; the worst stretches are below.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{place}: street {street}, from {min:.0f} m. Ellipses five times enlarged.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of {without_count} stretches nothing can be said: see the statuses above and the layer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The roads have no length: give lines along which vehicles drive.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The trajectory does not move: give that of a drive.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>More than {most_places:,} places: choose a larger spacing or fewer roads.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{control_count} control points. An error is where the survey has a point less where it truly is.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: {mean_2d:.1f} cm off in plan on average and {max_2d:.1f} cm at most, at {control_count} control points. Compare this with what the job asks for; the worst points are below.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Horizontal errors, {name}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The worst control points, {name}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{left_out} control points were not measured during this survey and are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The drives are placed with a standard deviation of {sigma:.1f} cm in plan (median; largest {max:.0f} cm).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{drive} shares no markings with other drives, control or reference: it stays as reported.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Looking for markings that drives share.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Looking for planes that drives share.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Adjusting {drives_count} drives with {observations_count} observations.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The drives share no markings and planes, and no control point or reference marking fits them: nothing can be adjusted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Control point {name} was measured by none of the drives: no trajectory passes within {control_reach:.0f} m of it at its time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ties change by more than drift within 20 m (a step of a trajectory): {stepped} may step there, and control or reference says which does.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} observations ({name}), {lost} without weight; RMS residual {plan:.1f} cm in plan, {up:.1f} cm in height.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No control point or reference marking fixes {relative}: these drives agree with each other, but their place is only relative.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing ties {loose} to anything: it stays as reported.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{paths} belongs to none of the trajectories: none covers its GPS times near its points. Give the trajectory of each drive.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No point cloud was measured along {name}: give the points of each drive.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No marking of {drive} could be registered to the reference markings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{output} must end in .laz or .las.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path}: no image was taken between {start:.1f} and {end:.1f} s, the time of the trajectory: give the poses of this survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{away_count:,} of {away_count_2:,} images were taken outside the trajectory's time: they were moved with its nearest pose.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{outside:,} of {points:,} points were measured outside the trajectory's time: they were {done} and are not to be trusted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{in_gaps:,} of {points:,} points were measured in gaps of the trajectory: they were moved by what lies between the gap's ends and are not to be trusted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No point was measured during the trajectory: give those of one survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{paths} is too wide for coordinates in steps of {min:g} m: store it in tiles or with a coarser step.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The coordinates are stored in steps of {max:g} m, too coarse for the correction: they are written in steps of {coarsest_scale:g} m.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points were measured at {time:.3f} s, outside the trajectory ({time_2:.3f} to {time_3:.3f} s): give the trajectory of the whole survey, or let them be moved with the nearest pose.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A point lies outside the bounds that the header of its file states: repair the header (lasinfo -repair).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{patches_count:,} planes in {first_pass} passes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{pairs:,} pairs of planes; they lie {rms_before:.1f} mm apart before and {rms_after:.1f} mm after (RMS).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The calibration holds no scanner: there is nothing to calibrate.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Only {pairs} planes were seen by two scanners or in two passes: drive a street with walls in both directions.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The passes lie {apart:.1f} m apart: correct the trajectories first (“Adjust several drives”) and place the points with them (“Apply corrected trajectory”).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing is determined: the calibration stays as it is. Drive a street with walls in both directions, and correct the trajectories first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The calibration has no scanner with point source id {point_source_id} (it has: {known}): add it, or choose the calibration of this survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is no calibration: it needs an entry “scanners” or “cameras”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: scanners and cameras must be lists of objects.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: “lever_arm_m” of {value} must be three numbers, metres forward, right and down.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: the lever arm of {value} is {max:.0f} m long; it must be in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: “{key}” of {entry} is no number.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has no column {missing}: control points need {columns} (heights may be left out).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} holds no control point.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: row {wrong} has no number in the column {column}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Control point {id} lies {away:.0f} m from its place in the survey: check that both are in the same coordinate reference system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No control point lies in the survey's time: there is nothing to measure.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: the column {column} holds something that is no number ({error}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The points of {paths} carry no GPS time, which ties them to the trajectory: export the survey with it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All GPS times in {paths} are zero: export the survey with the points' times.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{what} were measured from {span:.1f} to {span_2:.1f} s{kind}, but the trajectory runs from {wanted:.1f} to {wanted_2:.1f} s: give those of one survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Only {ground:,} of {candidates:,} points were found to be ground ({ground_2:.2g} %, needed {min_share:g} %), which cannot be right for a drive: look for many points below the road, a wrong height unit or a survey that does not show the ground; a smaller minimum ground share accepts it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{paths} holds no usable points: all are noise, withheld or have no valid height.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The survey is too large for one cloth: choose a coarser cloth resolution, or filter parts of it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has no column {missing} or no row: image poses need {columns}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has no number in row {bad}: correct or remove it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} holds a value that is no number ({error}): correct it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No control point lies in the survey's time: the trajectory cannot be updated.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The ground does not reach the trajectory's course: give a ground of the same place and coordinate reference system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The trajectory lies {above:.1f} m above the ground (median), not {start:.1f} m: check the origin's height and both height systems.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The range scans do not say which scanner measured them, and the calibration has {scanners_count}: add a column scanner.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All angles are within {max:.2f} degrees: if they are radians, say so.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The files hold no returns: choose other range scans.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The range scans were measured from {span:.1f} to {span_2:.1f} s, but the trajectory runs from {time:.1f} to {time_2:.1f} s: give those of one survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No return could be placed: all are without a range or outside the limits of range and time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The strip image was taken from {times:.1f} to {times_2:.1f} s, the trajectory runs from {time:.1f} to {time_2:.1f} s: give those of one survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is of no known kind: range scans come as {suffixes}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No range scans were given: choose one or several files.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The range scans {path} do not exist: check the file's name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} has no column {missing}: range scans need time, angle and range, and may have intensity and scanner.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{file} holds something that is no number{where} ({split}): correct it or export the scans again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be read as Parquet ({error}): check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has a return without a time or an angle that is a number (return {bad} of those read at a time): correct it or export the scans again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is a Parquet file, and the package pyarrow that reads these cannot be loaded ({error}): install it (pip install pyarrow) or export the scans as CSV.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be read ({error}): it may be cut off; copy it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The paper's method needs the height of the trajectory's origin above the ground: give it, or leave out the ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{unique_count} sets do not tell how good the tie points are: give their sigma, or add sets.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All {names_count} sets of tie points contradict themselves: check which place belongs to which, and the coordinate reference system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No set has two pairs: the paper's method needs sets of two; add pairs, or take another method.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sets {names} and {names_2} contradict each other: within {step:.1f} s the drift would change by {change:.1f} m; check both.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The tie points lie within {last:.0f} of {duration:.0f} s: the rest of the course is only moved along with them, and its sigma grows; add sets there.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The method must be one of {methods}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The standard deviations of tie points and heading must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{left_out} of {samples} samples of the ground along the course stand out and are left out: check that it is the ground that was driven on.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set {name}: {own_count} of {own_count_2} pairs contradict the others and are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set {name} contradicts itself and is left out: {reason}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set {name} has one pair and is left out: the paper's method needs two.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set {name} has {own_count} pairs: the paper's method takes the first two.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set {name} contradicts itself by {fit:.2f} m; the paper's method uses it all the same.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set {name} lies {away:.2f} m from where the other sets put it and is left out: check that survey and reference show the same place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set {name} lies {away:.2f} m from where the other sets put it: check that survey and reference show the same place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Correction to the {name} with its sigma.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The height of the origin above the ground was not given: the mean height stays as reported ({sensor_height:.2f} m above the ground).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{pairs} of {given}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground truths must be at different epochs, in the order of time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The calibration of camera {id} cannot be right: rows and focal_length_px must be greater than 0, margin_px less than half the rows.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No strip image was given: choose one or several images of line cameras.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The calibration does not say which camera took {path} (it has: {known}): give the camera's entry an “image” with this file name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has {rows} rows, its camera {id} has {rows_2}: choose the image of this camera.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The strip image {path} does not exist: check its name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} must have the columns column and time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} gives times for {unique_count} columns, {image} has {columns}: each column needs one, numbered from 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{image} has {columns} column: a strip needs at least two.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path}: the time of column {at} is not later than that of the column before; correct it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The strip image has no file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} must be an image of 8 or 16 bits.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The calibration of camera {id} has no number “{key}”: a line camera needs rows, focal_length_px and centre_px.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There are no times for {image}: put a table column,time named {path} beside it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be read as a table of times: {error}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} holds something that is no number ({error}): correct it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No corner of an outline lies within {max_distance:.0f} m of the course: give outlines of the same place and coordinate reference system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of {place_count} corners near the course no two were found in the survey close enough to each other: assign tie points by hand.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No point of the survey lies at the height of walls near the course within the trajectory's time.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The survey shows no walls: its points nowhere stand over each other.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path}: not every row has as many values as the header; the file may be cut off.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has no column {missing}: tie points need {columns}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} holds no tie points: give at least one set of two pairs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: in set {sets} survey and reference are {apart:,.0f} m apart; both must be in the survey's coordinate reference system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{shift:.0f} s were added to the times of the tie points, which are counted otherwise than those of the trajectory: make sure that both are of one survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{inside_count} tie points lie outside the trajectory's time and are left out (set {some}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All tie points lie in gaps of the trajectory: choose others.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The tie points of set {some} lie in a gap of the trajectory and are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{points_count:,} marking points on {marked_share:.0f} % of the path. </source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scanner {number}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scanner {number} has no curve and its points are left out: {reason}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No marking points were found: the road has no paint, or its intensity does not show it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The marking points are only {contrast_of:.1f} times as bright as the ground beside them: look at them before they are used.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The asphalt of scanner {number} does not follow one curve over range (residual {residual:.0f} %): several surfaces may have been taken together.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Single asphalt points of scanner {number} scatter by {scatter:.0f} %: only strong paint stands out, and bright specks may be taken for paint.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>too few ground points with intensity at different ranges</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the intensity of asphalt scatters too much to tell paint from it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no surface of even intensity can be followed over the ranges</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Block size, contrast, widths and steps of the marking extraction must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{outside:,} of {points:,} points were measured where the trajectory has no epochs and are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{standing:,} points measured while the vehicle stood are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Finding the markings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The largest range must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Finding the ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Taking the points of ground classes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The intensity of asphalt over range cannot be told in {paths} ({reason}): give a longer stretch of road.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The lasers of scanner {number} are told apart by {told_by}: asphalt scatters by {after:.0f} % instead of {before:.0f} %.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The block of the paper's threshold must be {pixel:g} m or larger, and c above 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The marking points' columns differ in length.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has no ground points near the vehicle: give the survey with its road.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has no intensity (all are 0), by which markings are told: export the survey with it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All points of {name} have the intensity {most:g}, by which markings cannot be told: export the survey with the measured intensities.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No point of {name} lies within {max_range:g} m of the trajectory{apart}: give both in the same coordinate and height system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The corrected trajectory runs from {time:.1f} to {time_2:.1f} s, the reported one from {time_3:.1f} to {time_4:.1f} s: give two of one survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No section of the survey could be registered to the reference markings: check that both show the same streets in the same coordinate system, and that the survey has intensities that show paint.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No window of the survey could be registered to the reference markings: check that both show the same streets in the same coordinate system, and that the survey has intensities that show paint.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Matrix is not positive definite</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lengths, grids and counts of the registration must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The expected share of outliers must lie between 0 and 1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points score in the cells {cells}, not {cells_2}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The longest window must not be shorter than the smallest one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A registration in 3D needs the ground's heights: give a ground raster or marking polygons with z.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No marking point was measured within the trajectory's time: check that both are of one survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no reference marking near the survey: check the CRS of both and that the reference covers the drive.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>: left as reported (red), right corrected (green). A picture is {side:.0f} m wide.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Registering {markings_count:,} marking points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Taking road markings out of the survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{share:.0f} % of the path is registered, {share_2:.0f} % bridged; {spread}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No part of the survey could be registered to the reference markings, so that there is no result: check that both show the same roads, and the maximum error.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No road marking was found in the survey: check its intensities with “Road markings of a mobile survey”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The attribute {weight} of {paths} holds values below 0: give markings as “Road markings of a mobile survey” writes them, or the survey itself.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The reported heading contradicts the markings by {correction:.1f} degrees (median), much more than its accuracy: it was corrected; check the calibration and the trajectory.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{share:.0f} % of the path is not to be trusted, the longest section from {longest_start:.0f} to {end:.0f} m ({reason}): see the patches' layer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has {bands} bands and is an image, no mask of road markings: {advice}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is above 0 in {marked:.0f} % of its cells, so that it is no mask of road markings: {advice}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} holds no road marking: no cell is above 0; {advice}, or give that of another place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has many different values and is an image or a surface, no mask of road markings: {advice}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The trajectory drives {chainage:.2f} m, less than one patch of {length:g} m: give a longer one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The survey lies {middle:.1f} m {value} the reference's ground: heights above the ellipsoid and above sea level cannot be mixed, convert one of the two.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The reference markings must be polygons and at least one: choose another layer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has cells of {cell:g} m: road markings need {coarsest:g} m or less, and a CRS in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>below</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>above</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no bar among the markings of the survey or of the reference, whose corners could be control points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No corner of a marking in the survey lies near one of the reference.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} lies {length} from where the vehicle was at its times: {reason}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All points of {name} lie more than {above:.0f} m {value} the trajectory: heights above the ellipsoid and above sea level cannot be mixed; convert one of them (a geoid model can be given for SBET).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{what} {reach} {length} from the path of the survey: give those of the same place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{what} cover{value} {share:.0f} % of the path only: the rest cannot be registered.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The vehicle is {middle:.0f} m {value} the ground elevation: heights above the ellipsoid and above sea level cannot be mixed, convert one of the two (a geoid model can be given for SBET).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The trajectory runs from {time:.3f} to {time_2:.3f} s, but a pose is needed at {worst:.3f} s: give the trajectory of the whole survey.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has {there} but no {missing}: give the standard deviations of all three angles, or of none.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is no RMS file of an SBET or is cut off: its length is no multiple of {itemsize} bytes; export it again, or put it elsewhere.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} does not belong to the trajectory: its times run from {time:.1f} to {time_2:.1f} s, the trajectory's from {time_3:.1f} to {time_4:.1f} s; give that of the same solution, or put it elsewhere.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} holds a standard deviation of an angle that is not above 0 and below 90 degrees: correct or remove it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} holds a standard deviation that is no number ({error}): correct it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path}: row {ragged} has {rows_count} values, the header names {header_count}: the file may be cut off; export it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has no column {missing}: a trajectory needs {columns}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has {table_count} epochs: give a trajectory of at least two.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has one epoch only: give a trajectory of at least two.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is in latitude and longitude: the coordinate reference system of the survey must be known; store it in the point cloud or give it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is no SBET file or is cut off: its length is no multiple of {itemsize} bytes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} is no SBET file: its latitudes are no angles in radians.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} has no number in record {bad}: export it again, or remove the record.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path}: its angles are no radians, as those of an SBET are: export it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} lies outside the coordinate reference system of the survey at record {bad}: choose the right one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} gives two different poses for the time {time:.4f} s: remove the wrong one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A trajectory that came as a layer is written as a layer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: angles of up to {max:.0f} are no radians: they are degrees; say so.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: the headings lie {off:.0f}° beside the direction of travel (median), but read as {angle_names} they go with it ({away:.1f}°): say that the angles are counted so, or convert them to {angle_names_2}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No point of {paths} was measured beside the path at the height of its road: give points and trajectory of one drive, in one coordinate and height system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There are {found:.1f} ground points a square metre beside the path: edges need {sparse:.0f} or more; give the whole survey, not a thinned one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A drive leads from one lane to another here, but bounds along it would cross; no virtual lane was made.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A drive leads from one lane to another here, but bounds along it would cross; they are drawn at a lane's width about a smooth curve.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A drive runs {end:.0f} m outside all lanes here: lines are missing, or were not seen.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The bound is drawn through {unseen:.1f} m without a line.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A strip of lane width ({width:.1f} m wide, {end:.0f} m long) shows neither drive nor arrow nor a lane line to a lane beside it; no lane was made.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drives, arrows or stop lines contradict each other about the direction here.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Arrows or stop lines contradict the drives about the direction here; that of the drives was taken.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>More than one {kind} has the id {number}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The way refers to node {missing}, which is not in the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The way has no tag type.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The lanelet has no speed limit: that of the traffic rules will hold, or none.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The lanelet has {left} left and {right} right ways that can be read; it needs one of each.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Two points of the line follow each other within {steps:.3f} m.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The lanelet's bounds cross or are the same way.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A bound of the lanelet crosses itself.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The lanelet is {min:.2f} to {max:.2f} m wide.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The regulatory element has no tag subtype.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The regulatory element refers to nothing (role refers).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No regulatory element refers to this stop line.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No regulatory element refers to this crosswalk.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The lanelet has neither a next nor a previous one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The lanelet is an end of the map: no other follows it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The lanelet is an end of the map: none leads to it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The way has fewer than two nodes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The relation refers to {kind} {member}, which is not in the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The painted line has no tag subtype (solid, dashed).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The lanelet has no tag {tag}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The bounds of lanelets {identifier} and {identifier_2} coincide but are two ways ({way}, {other_way}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No lanelet refers to this regulatory element.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Places of the map have no latitude and longitude in its CRS: check the CRS of the lines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The map lies in more than one MGRS square, in which Autoware's local coordinates would repeat: take the projector TransverseMercator.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The lines' CRS cannot be brought to latitude and longitude, which a Lanelet2 file needs: assign a projected CRS known to PROJ.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A drive runs between lines that leave less than a lane: {min:.1f} m, for {span:.0f} m; no lane was made.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lane {one} leads to lane {other}, but OpenDRIVE knows one road or junction at the end of a road: the connection is missing in the OpenDRIVE file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The lines' CRS cannot be written as a PROJ string, which OpenDRIVE needs: assign a projected CRS known to PROJ.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No trajectory was given: only arrows and stop lines tell directions, and nothing connects lanes through junctions.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No drive shows where this lane leads to.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No drive shows where this lane comes from.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No lane of the map ends at this stop line.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frame {number} of {exposures_count}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line scanners</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mobile survey {number} of {survey_times_count}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no fault {name!r}: choose among {faults}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{folder} is a file: give the name of a new folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {folder} is not empty: give the name of a new one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {parent} does not exist: create it or choose another.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {parent} cannot be written: choose another.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no scene {scene!r}: choose one of {scenes}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The size of the city must be {min_size:g} to {max_size:g} m, not {size:g}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be written: {error}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {folder} cannot be written ({strerror}): choose another.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The cloud has no point with a usable height.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The cloud has no points that could be ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cloth resolution, threshold and iterations must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The cloth's rigidness must be 1, 2 or 3.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A surface needs at least three points: check the input's extent.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All points lie on one line: a surface cannot be built from them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The cloud holds no usable points: all are noise or have no valid height.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The ground source must be automatic, classes or cloth, not {wanted}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The cloud has no ground points (class 2): choose the cloth filter instead.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The cloud has no ground points, only points classified as something else (such as buildings): give the whole cloud with its ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No ground points were found: check that the cloud shows the ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} states no coordinate reference system: assign one to the file first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is in {crs}, which is not projected: reproject it to metres first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} is in {crs}, which is not in metres: reproject it to metres first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Finding the highest points of the cells.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Settling the cloth.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The resolution must be greater than 0.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The longest edge must be 0 or greater.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground by {value}: {reason}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{left_out:,} of {triangles:,} triangles were longer than {max_edge:g} m and left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{far_share:.0f} % of the surface spans {far:g} m or more without points (water, gaps): set a longest edge to leave such places out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The raster would have {columns:,} x {rows:,} cells: choose a coarser resolution, or check for points far outside the area.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The area is too large for one cloth: choose a coarser cloth resolution.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Triangulating the ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Triangulating the surface.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The points lie in fewer than three places or on one line: a surface cannot be built from them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>classes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the cloth filter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder of the run, {run_folder}, is not there any more or cannot be written ({strerror}): put it right and run again; tiles that are whole are kept.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no room in the folder of the run, {run_folder} ({strerror}): make some and run again; tiles that are whole are kept.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder {run_folder} cannot be written ({strerror}): choose another.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Another run works in {run_folder}: wait for its end, or choose another folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Map sheets need a plane rectangular system of Japan, and {plan} is none: choose squares or meshes, or reproject the data.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The data states no coordinate reference system, which map sheets need: give it (POINTS_CRS), or choose squares.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The data leaves the area of the map sheets, 160 km east and west and 300 km north and south of the origin: choose squares or meshes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} cannot be written ({error}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{path} of the tile {parent} has other cells than the first tile: the rasters cannot be put together.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The data states no coordinate reference system, which meshes need: give it (POINTS_CRS), or choose squares.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The extent of the data is not a number: check its coordinates.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The data is not in the range of Japan's meshes, 0 to 66 degrees north and 100 to 180 east: choose squares.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The data would take more than a million meshes: choose larger ones, or check the coordinates.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This is an estimate from {records_count} of {tiles_count} tiles.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{failed_count} more are in the layer of tiles.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} of {tiles_count} tiles failed; the others are whole. Run again with the same folder when the reasons below are put right: only the failed tiles are then done.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All {tiles_count} tiles are done.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The points have no GPS time, by which a survey is cut into stretches: give a point cloud with times.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The drive would take more than a million stretches: give longer ones.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The side of a tile must be a whole number of metres, and its buffer not negative: change them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The data would take {count:,} tiles of {size:g} m: give larger tiles, or check the coordinates.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: no raster can be opened; check the files.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} has no field {1}; give the points of “Orthorectify frames”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} x {2} pixels</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In {0} outlines the surface shows no building.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} frames used; {1:.1f} % of the ground outside buildings seen, {2:.0f} m2 in holes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} are given for {2} frames; give one for each frame, in the same order.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} has no field {1}; choose another.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The field {0} of {1} must hold numbers: heights above the ground in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing of the orthophoto is left to look at: check that roads, buildings and hidden areas lie where the image does; the mask is empty.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No markings were found: the mask is empty; check the roads, or lower the contrast.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the coordinate reference system is missing; assign the one that the image is in (Layer &gt; Set CRS).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: its pixels are measured in degrees; warp it to a projected CRS, such as the local plane rectangular or UTM zone.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: there are no polygons; check the layer and its filter, or leave it out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>With pixels of {0:.2f} m only wide markings can be seen; 0.15 m or finer shows lane lines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} has no height at {1} of {2} markings: they lie outside of it or in its gaps, and have no height there.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} buildings have no model; the field “reason” says why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} buildings ({2} %) have no ground under them: their bases are taken from neighbours or assumed; give a ground elevation or a field with the base height.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} models have a flaw; the fields “status” and “reason” say which.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the field {1} is missing or has empty values; give the result of “Roof polygons”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: this system's GDAL cannot write GeoParquet; give a name that ends in .gpkg.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} and {1} are both given: give one of them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} is no day; give it as 2026-04-01.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give point clouds, a raster or a layer, one of them, and the output of that kind.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give a grid, or one value in its place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} heights changed by {1:+.3f} to {2:+.3f} m, {3:+.3f} m in the mean, into {4}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: no feature has heights (z); there is nothing to convert.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the fields {1} hold heights of before; compute them anew.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No output is asked for; choose one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A city model is written to other files only; for a layer use “Load city model”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give either {0} or {1}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: there is no field {1}; choose one of the layer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the field surface_type is missing; give the surfaces of “Building models”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: no feature has faces with heights; give building models (MultiPolygonZ), such as those of “Building models”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} buildings have no model and are written without a shape.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} ids were empty or there more than once; they got a number.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} buildings have a solid that is not closed or not valid; it is written as surfaces, and the field “problems” says why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} images of textures are missing ({1}); their faces have none.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No face of {0} has a texture in {1}; check that both are of the same buildings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} is not written from a city model; for a layer use “Load city model”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No file was given: choose a city model (.gml, .json, .jsonl, .zip) or a folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} buildings in {1}, heights: {2}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} is not known; choose another.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} buildings have something wrong; the field “note” says what.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No file was given: choose building outlines of the GSI (.xml, .zip) or a folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} buildings, {1}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No file was given: choose elevation models of the GSI (.xml, .zip) or a folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} meshes ({1}), heights in {2}, {3:.1f} to {4:.1f} m, {5:.1f} % of the cells empty</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The elevation model was taken into {0} by {1}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give the building models either as a layer or as a CityJSON file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the walls have no field status, which tells how well each was measured; give the result of “Walls from a mobile survey”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} buildings could not be merged and keep their models; the field “reason” tells why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} walls are no upright faces and are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the walls have no heights; give the result of “Walls from a mobile survey”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} buildings have no mesh; the field “reason” tells why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} meshes have fewer than 95 % of their uppermost points within the stated error; the field “within” tells how many.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} buildings got no roof polygon.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} buildings have too few points for a model.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} is {1} m, more than {2}, {3} m: heights between the bins would be lost; give at most the width.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} buildings have no roof in their points.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No wall was found: the survey shows too little of the buildings, or does not lie on the map.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The buildings tell no heights: coverage is counted up to the highest point seen of each wall.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} buildings near the survey show no wall.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the files state no coordinate reference system; they are taken to be in that of {1}, {2}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} does not exist; check its name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: no file was given; give one or several LAS or LAZ files.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} cannot be opened as a raster; check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} is no file; export the layer to a GeoTIFF first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Step: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} does not reach {1}; give a raster of the same place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} cannot be opened as a vector layer; check the file and the layer name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the file {1} does not exist; check its name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} is no LAS, LAZ or COPC file; convert it first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: no feature has a polygon; choose a layer of outlines or building models.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The Dask scheduler was lost during the work; start it and run again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The Dask scheduler at {0} has no workers; start some.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The cluster's workers were ended at one piece again and again ({0}); give them more memory.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The package distributed is not there; install it (pip install distributed) to send work to {0}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No Dask scheduler answers at {0} ({1}); check the address, such as tcp://host:8786.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The worker {0} has another version of UrbanMap loaded; restart the workers.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The worker {0} has other packages than this machine: {1}; install the same there.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The worker {0} does not see the folder {1}; put inputs, outputs and temporary files (TMPDIR) on storage that all machines share.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no CRS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>unnamed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the coordinate reference system is missing; assign the one that the data are in (for a layer: Layer &gt; Set CRS).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: coordinates are degrees in {1}; reproject to a projected CRS in metres, such as the local plane rectangular or UTM zone.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} counts in units of {2:.4f} m; reproject to a CRS in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} is in {1}, but {2} is in {3}; reproject one of them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the coordinate reference system is missing; assign the one that the data are in.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} would take the place of {1} ({2}); choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} is one of the images in {2}; choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} and {1} have the same name, {2}; give each its own.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>status</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>reason</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>standard deviation (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>standard deviation of the height (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>standard deviation of the heading (°)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>length (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>width (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>height (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>area (m²)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>volume (m³)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>points a m²</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMSE (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMSE of the height (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMSE of the height, best 95 % (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMSE of the distance (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>95th percentile of the distance (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>east (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>north (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>up (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>time (s)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>chainage (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>heading (°)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>azimuth (°)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>colour</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>kind</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>class</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>quality, 0 to 1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>confidence, 0 to 1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>coverage, 0 to 1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>satellites</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>level of detail</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>kind of roof</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>kind of surface</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>valid solid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>watertight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Add files…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} files</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Name</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>own</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How it works</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Installing Python packages for UrbanMap</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>UrbanMap: Python packages</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Install</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All Python packages that UrbanMap needs are there.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The packages are installed; the algorithms can be used now.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Missing: {0}. They are installed into a folder of the QGIS profile; what QGIS brought with it stays as it is.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Still missing: {0}. Restart QGIS and look again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The feature has no polygon.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The polygon was invalid and was repaired ({0}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: none of the {1} features has a polygon; choose a polygon layer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: there are no polygons to work on; check the layer and its filter.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} of {2} polygons are empty, or invalid and were repaired (feature ids {3}{4}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the folder {1} does not exist or cannot be written; choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} cannot be written; choose another output.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} cannot be written ({1}); close the program that has it open.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} cannot be written: {1}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} cannot be written to {1}; choose another file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} and {1} lie on each other only where x and y of one of them are swapped; swap them in the one that counts x to the north.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the field {1} must hold the buildings' numbers as an earlier step wrote them; remove it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: some {1} is empty; give each building its own, or remove the field.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} outlines have no usable polygon; their buildings keep their rows.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the field {1} must hold numbers; convert it or choose another field.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the {1} {2} is there more than once; give each building its own, or remove the field.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Unknown parameter {0} is ignored; {1}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} is none of {2}; give one of these words, or its number from 0 on.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the name {1} must end in .laz or .las.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: reprojected from {1} to {2}, the system of the points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: its longitudes and latitudes seem to be swapped ({1:.3f}, {2:.3f}); swap x and y (“Swap X and Y coordinates” in the toolbox).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The points' heights are in {0}, which this release of QGIS cannot state in layers; files of city models state it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>result of an earlier step</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not stated by the inputs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>UrbanMap</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The style {0} could not be given to {1}: {2}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The style {0} is not saved in {1}: {2}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} cannot be written whole: make room on its disk, and run again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The process that worked on this tile was ended, by lack of memory or a fault in a library; make the tiles smaller.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There are no points in this tile.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} Tiles that are whole are kept.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There are no outlines in this tile.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} does not reach this tile.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A fault in the program ({0}: {1}); {2} in the tile's folder tells where.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing was given that says where the tiles are; give point clouds or a raster.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} is cut into stretches of the drive, not into meshes or sheets: leave out the grid, and give the length of a stretch as the side of a tile.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} are needed to run {1} over tiles; give them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Settings: “{0}” is no line NAME=VALUE with a parameter of {1}; it has {2}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Settings: {0} is a parameter of the run itself; give it there.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} ({1}) must be given over tiles, because each tile would choose for itself.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} cannot be made tile by tile; make it of the merged layers.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} is sorted into tiles.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} is neither a CSV, an SBET nor a point layer; check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A worker ended before its work was done, for lack of memory or because Python could not start it; run again with one worker.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No wall was moved: the observations do not decide; the field “reason” of the walls tells why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} walls were adjusted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} observations left out: {1}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: no file was given.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the layer has no field {1}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: give three numbers, such as 0.5, 0, -1.8.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give a trajectory, or a time for an area.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: a raster is made of an area only; leave out the trajectory or it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} places lie inside buildings and have no number.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>None of the {0} facades is seen in an image, so that there is no result: check that building models, trajectory and images are of one place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} facades have no texture; the field “reason” of the layer of facades tells why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The coordinate reference system is not known: the point cloud is written without one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scanner {0}: {1} points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} returns were measured outside the trajectory or in a gap of it and are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No image was given; give line images, frames or an orthophoto.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No image was given; give line images or frames.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: is needed for these images; give it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} outlines could not be measured; the field “reason” tells why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is nothing to draw; give laser points, or models or lines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing lies in {0} of {1} images: {2}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} was given, but not {1}; give both.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The tie points have neither columns x_mms,y_mms,x_ref,y_ref nor lines from survey to reference.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The height of the origin above the ground was not given: the mean height stays as reported ({0:.2f} m above the ground).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} would be written over another trajectory; choose another folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrected image poses are wanted, but no image poses are given.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>as reported</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>corrected</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} is neither a raster nor a polygon layer; check the file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} is neither a raster nor a polygon layer; choose another one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sample city…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Documentation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Install Python packages…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The model {0} cannot be loaded.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The module {0} cannot be loaded:</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check of a lane map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Faults by rule</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Severity</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rule</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} lanelets, {1} errors, {2} warnings. Where errors are, the map cannot be loaded or routed; warnings are worth a look.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Element</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: the file holds no lanelets (relations of type lanelet); give a Lanelet2 map.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The first 500 of {0} are shown; the layer holds all.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: no building has a height; give solids or outlines with heights.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: no feature has an edge; give polygons or lines of markings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} has no field sigma; give walls whose accuracy was measured.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give buildings, markings or both: there is no map without them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give roads or trajectories, not both.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing can be said of any place: see the field status.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing was simulated: no building has a height.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: satellites need buildings that hide them; give these too.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: scans are simulated of buildings; give these.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1} of {2} features have no heights and are left out; give the field with the height of their tops.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of lanes (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bounds seen, share</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median sigma of bounds (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Driven near the map (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of it inside lanes, share</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lanes pale, ways through junctions red, arrows with the traffic; drives dotted, findings numbered.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No lane was made: nothing shows the direction of any strip between lines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No trajectory was given: only paint and road axes tell directions, and nothing leads through junctions.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>left</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not shown by drives; left assumed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Junctions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Kind</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} lanes of {1:.0f} m together, and {2} ways through junctions that were driven.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0:.0%} of the length of the bounds was not seen and is drawn through gaps; see the findings “bound not seen”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Evidence on directions contradicts itself at {0} places.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Direction from: {0} (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Junction {0}, about {1:.0f}, {2:.0f}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The first {0} of {1} are shown; the layer holds all.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The map is not connected along the drives at {0} places; see the findings “driven without lane” and “way not drawn”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No lines.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No line was found in the {0} polygons: check that they are road markings in metres, and lower the minimum line length for short ones.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} is given but {1} is not: name the GeoPackage that it is to go into.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}, {1}: {2}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No kerb was found along {0:.0f} m of path: the road has none, or the points are too sparse or too noisy to show steps of a few centimetres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Without trajectories only arrows and stop lines tell directions: most strips stay findings, and nothing connects lanes through junctions.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No lane was made: the drives run beside all lines; check that both are of one place, in one CRS, and that the trajectories are corrected.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} has no field class; give the lines of “Lines from road markings”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} has no fields class and heading; give the areas of “Lines from road markings”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No folder was given: give the name of a new one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frames used: {0}; holes that no frame sees outside buildings: {1:.0f} m².</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} tiles, {1} kept from an earlier run, {2} to do.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}, tile by tile</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} cannot be run over tiles: {1}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All {0} tiles are empty; check that the inputs lie in one place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}: {1}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tile {0} failed: {1}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Road markings from the air</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Result</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>of these white</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>of these yellow</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marked area (m²)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Searched area (m²)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marked share of it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pixel (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median width (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Total length of strokes (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Shifts between overlapping frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same markings in two frames, the second against the first, median over the places. A good block agrees to half a pixel. “height”: without a surface, heights may explain the shift.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>second</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>sigma (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>places</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>apart</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>agree</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing stands out; check some markings against the picture all the same.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What to distrust</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Figures of the markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markings by width</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>grey values above the road</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markings by contrast</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Coverage</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>confidence</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markings by confidence</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Merged building models</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean offset of the moved walls (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>number</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings by the largest offset of a wall</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no points, no roof, no outline, or no valid solid could be made</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>level roofs or one height for all, as the detailed solid was not valid or did not fit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>too few points for roofs: one height for the whole outline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>many points that can be roof lie far from the model: roofs are missing or metres off</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>a roof found in the points is not in the model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lower than a storey over the ground: a deck, a platform, or ground taken for a roof</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>its ground is not known: taken from neighbours, or put under the lowest roof</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>a large part of the outline has no model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>a large part of the plan has no roof points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>so few points that parts of the roof cannot be separated</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>a plan too small for the shape of a roof to be seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>a valid solid from its roofs, near all of its points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean RMSE of roof heights (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean RMSE of the best 95 % (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean point to model distance, RMSE (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean quality, 0 to 1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>what it says</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Quality</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distances to the models of all points that can be roof, whether or not a roof was made of them. Level roofs (lod 1.3) in place of sloped ones show the slope as height differences.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings by quality</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>% of the points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings by points that the model does not explain</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMSE of height, best 95 % (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings by height error</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>95th percentile of distance (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings by point to model distance</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings by point density</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>% of the plan</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings by plan without points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMSE of height, best 95 %, of each building; the worst are numbered. North is up.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls adjusted by GNSS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Held back to keep buildings valid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not observable</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Independent observations</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Signals in them</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median sigma of adjusted walls, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median size of their offsets, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Iterations until nothing changed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls before and after</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buildings as given (grey). Adjusted walls: where they stood (dashed) and where they stand now, blue inwards, red outwards; the label is the offset in cm. Orange: observed, but not decided.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls that stay where they are</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A wall that is not observable may stand where the model has it or a metre off: nothing is known of it. More passes help where observations are few; nothing helps under open sky.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Walls with observations</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>offset, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>sigma, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>moved, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>observations</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>passes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>share of inliers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How the observations scatter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Error of an observation besides its noise, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Factor of the noise expected</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of NLOS-delayed ones</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Their mean delay, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of outliers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What the offsets leave of the observations: NLOS-delayed ones are to the right; the first and the last bar hold all that is beyond.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>By system</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residuals in line of sight: median, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residuals in line of sight: quartile range, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reflected signals with a known clock</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>of these within 5 m of prediction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>of these within 10 m of prediction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>of these: median difference, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sky plot (grid north up, horizon outside): green in line of sight, orange reflected, grey blocked.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>what</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>how many</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>signals without a known receiver clock (fewer than three in line of sight)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>share of signals near an edge: class not sure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>epochs with the antenna within a building</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reflections by ground, vehicles, bridges and trees, two reflections in a row and diffraction at edges are not traced; walls are taken for flat and upright.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No wall was moved: the observations do not decide. The table below tells why; more drives along the walls help.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measured against predicted excess path of reflected signals, m: dark where the class is sure. Above the line signals are late, at the foot the direct signal got through.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>residual, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>in line of sight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>blocked, no single wall reflects it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>reflected by one wall</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Edges over images, before and after</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Images</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No edge lies in any of the images: they are of another place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of road, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median sigma of the weakest direction, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Places that look like others</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>length, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>share</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>source</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>along, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>across, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>heading, degrees</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Medians over the places of which the source tells something. A direction without evidence keeps the sigma from before matching.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>sigma of the weakest direction, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Places by the semi-major axis of their error ellipse.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Plan</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Error ellipses, ten times enlarged, by class: green good, yellow usable, red poor, grey nothing can be said.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Status</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Worst stretches</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>street</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>from, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>to, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>bearing, degrees</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Predicted against observed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scans were simulated at some of the places, with noise, vehicles and trees in the way, and registered to the map with the plugin's own NDT.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spearman's coefficient over all places</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median of it within a street</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the errors within the 95 % ellipse</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median observed error in plan, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median predicted error in plan, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the rays to walls that were hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scans that fit another place better</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Root mean square errors in plan of each place; those above the picture are drawn at its edge.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>way, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>predicted along, across, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>observed along, across, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>within 95 %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>elsewhere</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing can be said of any place; the table below tells why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No place could be simulated: walls tell nothing of any.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accuracy at control points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mean 2D (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>max 2D (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>std 2D (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mean 3D (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>max 3D (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>std 3D (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>East, north and up are mean errors: what is left in all points alike.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Control point</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Horizontal error over time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Horizontal error of each control point</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>seconds since the first control point</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Adjustment of several drives</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residuals by kind</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Observation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>without weight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMS in plan (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>largest in plan (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMS in height (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>largest in height (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drives</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drive</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>path length (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mean correction in plan (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>median sigma in plan (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>largest sigma in plan (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Largest residuals</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>drive</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>other drive</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>in plan (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>in height (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>weight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Correction along the path</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Standard deviation of the correction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The drives agree with each other, but nothing fixes their place: give control points or reference markings, or use the result only for comparing drives.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>plan</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>placed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>bridged</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>relative only</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not tied</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance between planes before, RMS (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance between planes after, RMS (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Passes apart, RMS (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>value</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>unit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>standard deviation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lever arms in metres forward, right and down; angles in degrees about the body's axes. A misalignment of the inertial unit that all passes have in common is part of the angles.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibration of scanners</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The course as reported (grey) and rectified (blue; dashed where it is extrapolated beyond the sets), and the sets of tie points: green used, orange suspect, red left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drift</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sets of tie points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time, s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pairs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Before, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>After, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>East, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>North, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heading, °</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Misfit within, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Off without itself, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Before and after: mean distance of the set's pairs from the reference. Off without itself: how far the set would lie from the reference if it were not used, which is more than what to expect halfway between sets.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Correction to the heading with its sigma.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height of the origin above the ground, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Samples along the course</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>left out, they stand out of their neighbours</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the course with a ground</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance from the ground before, root mean square, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>after, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sigma of a sample, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sigma of the heights, mean, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>maximum, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Correction to the height with its sigma, and the samples of the ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The sigma of the tie points was found from how well they fit each other. An error that they share, such as that of the reference, is not in it nor in the sigmas of the epochs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heights</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Heading correction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ground says</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>taken</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>sets</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>used; its pairs lie too close together, as seen from the vehicle, to tell the heading</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>used, but far from where the other sets put it: check it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>left out: the other sets put it elsewhere</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>left out: its pairs do not fit each other</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>left out: the paper's method needs two pairs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>relative</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>iterative</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>paper</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>best estimate of the drift from all tie points together</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>relative motions adjusted between sets, closed form (Z 3.1)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>relative motions adjusted between sets by the paper's iteration (Z eq. 8, 9)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Z 3 to the letter: sets of two pairs (eq. 13 to 17), relative motions by iteration (eq. 8, 9)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Their intensities follow the curves of the scanners.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Asphalt's intensity falls with range and incidence. The curve f(R) = C + A R^-b (1 - exp(-(R/d)^2)) is fitted to the asphalt of each scanner; intensities are divided by it up to R1, by the smallest value from there to R2, and left out beyond (Javanmardi 2018, eq. 4).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Files</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Outside the trajectory's time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measured while standing (left out)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Within range of the vehicle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>On the ground</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground told by</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ground within R2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of marking points among these, %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Contrast of paint to the ground beside it (median)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Path with markings, %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scatter of the ground's heights, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reference intensity</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>cloth filter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lasers told apart by</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lasers (of the angle: bins of 0.1 degrees) used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Left out (no signal or too much scatter)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smallest gain</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Largest gain</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scatter on even ground before, %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>After, %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Asphalt's intensity in bins of 0.25 m (dots; grey: not used), the fitted curve as it is applied (line), R1 and R2.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>C (floor)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A (at 1 m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>b (fall)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>d (loss near the scanner), m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Shortest range, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>I_M (largest intensity of asphalt)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>I_m (smallest)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>I_ref</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bins used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residual of the bins (robust), %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scatter of single asphalt points, %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range, m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Asphalt</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Curve</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Difference, %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>registered</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not to be trusted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>weak</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ambiguous</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not converged</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Registration of a mobile survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Registered: found from markings around. Bridged: between or beyond registered parts, by how trajectories drift. Not to be trusted: too far from them, or markings that contradict. Standard deviations include what the reference itself is off by.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> Heights, roll and pitch were not touched.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Correction of the reported positions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Correction of the reported angles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Windows</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of the window of each patch: as long as it needs for enough markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of a window's marking points that lie on reference markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>to (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>from time (s)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>to time (s)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>why</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>largest sigma (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markings before and after</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marking points of the survey over the </source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>aerial image</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>reference markings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No part of the path is registered: the result is as reported. Check that the reference is of the same place, and its date.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Each patch is moved by its own window, as in the paper: between patches there are steps, nothing is bridged, and patches that are not to be trusted are moved all the same.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance of each window's own correction from the smooth one, in plan</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>window length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>overlap</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>windows</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Done</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Empty</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Failed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Kept from an earlier run</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Buffer (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time of all tiles (s)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Processor time of all tiles (s)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Slowest tile (s)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Greatest memory of a process (MB)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Disk of the results (MB)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tiles: done green, empty grey, failed red, not done white. North is up.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reason</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time (s)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>time of a tile (s)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How long the tiles took.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>placed, σ up to 5 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>placed, σ above 5 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>residual below 2 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>2 to 5 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>5 cm and more</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ok</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>error exceeded</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ground assumed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>small</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>few points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>part of the plan without points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>part of the outline without model</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>low</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lost roofs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>points not explained</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>simplified</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>plain block</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not modelled (see table)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>outer wall</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>inner wall</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>error below 3 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>3 to 10 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>10 to 30 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>more than 30 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>seen well</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>seen in part</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>rough</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>inside the outline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>textured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>agree to half a pixel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>displaced by heights</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>walls adjusted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>as given</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>reflected</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>blocked</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>adjusted inwards</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>adjusted outwards</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>held: the building would not stay valid</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>observed, not decided</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not observable</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>普通建物 ordinary building</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>堅ろう建物 solid building</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>普通無壁舎 ordinary, no walls</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>堅ろう無壁舎 solid, no walls</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>other</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>road border</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>virtual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>virtual, through a junction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>sound</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>with a note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>good</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>usable</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>poor</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>nothing can be said</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>below 10 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>30 to 50 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>50 cm to 1 m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>above 1 m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>warning</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>info</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no lane made</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>open end</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>bound not seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>direction contradicts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>driven without lane</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no drive</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>stop line without lane</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>too narrow</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>way not drawn</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>way drawn by width</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>others</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>diamond</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>unknown</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>arrow straight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>arrow left</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>arrow right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>arrow straight left</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>arrow straight right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>arrow, kind unknown</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>guiding strip</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no marking</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>on measured walls</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>unchanged</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not merged (see table)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>on the measured wall</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lay on it already</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>beyond the limits</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>would cross a neighbour</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>does not fit the plan</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>registered, σ up to 3 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>registered, σ 3 to 6 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>registered, σ above 6 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>σ up to 5 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>σ 5 to 20 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>σ above 20 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>carried on before the first or after the last set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>used for the position only</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>used, but hardly fits its neighbours</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>left out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>kerb, measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>kerb, doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lowered kerb, measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lowered kerb, doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>road border, measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>road border, doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>guard rail, measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>guard rail, doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>wall, measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>wall, doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>white</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>yellow</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lowest roofs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>highest roofs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>below 4: no position</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>4 to 5</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>6 to 8</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>9 to 12</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>13 and more</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>inside a building</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>in its place</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>moved to its points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>place not observable</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>too few points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>survey to outline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>done</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>empty</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>failed (see table)</source>
        <translation type="unfinished"></translation>
    </message>
</context>
</TS>
