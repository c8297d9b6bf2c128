"""CityJSON and its sequences, read and written."""
