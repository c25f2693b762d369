"""Parts of soak.py."""

# Who joins proves that its program makes the same land. In continents that takes seconds, and the bots share a thread.
GENERATOR = "overworld"
