"""The rules of the specification of 3D city models (Project PLATEAU), and what breaks them."""
