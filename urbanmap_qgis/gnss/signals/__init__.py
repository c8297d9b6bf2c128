"""Code observations with everything known taken off: geometry, clocks, atmosphere."""
