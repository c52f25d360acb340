"""The footwork command, one file a subcommand."""
