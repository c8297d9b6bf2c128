"""One smooth correction of the trajectory from what all windows say, with its sigma."""
