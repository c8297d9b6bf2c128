"""Areas cut into tiles: planned, cut, kept account of and put together again."""
