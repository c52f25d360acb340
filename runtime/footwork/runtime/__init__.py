"""The tick: clock, world, sessions, server."""
