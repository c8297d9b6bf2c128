"""Files written beside their place and moved there whole; readers that answer in one sentence."""
