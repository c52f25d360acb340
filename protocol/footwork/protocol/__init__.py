"""Messages, codec and client of the wire protocol; SPEC.md stands beside it."""
