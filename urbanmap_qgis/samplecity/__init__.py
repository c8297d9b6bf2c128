"""A made-up city with known truth: what every sensor would measure there, written in UrbanMap's formats."""
