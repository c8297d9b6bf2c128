"""How well a vehicle can know its place from the map: predicted accuracy of localisation (J 6.2)."""
