"""What is learned from answers about road markings: nothing in it looks at images."""
