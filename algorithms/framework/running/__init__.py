"""How a run goes: workers, cluster, signals, libraries, what reports tell of it."""
