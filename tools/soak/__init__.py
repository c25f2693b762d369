"""Parts of soak.py."""

# A joining client proves that it generates the same terrain. With continents that takes seconds, and bots share a thread.
GENERATOR = "overworld"
