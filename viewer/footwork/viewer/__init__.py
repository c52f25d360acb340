"""The live view: a page in a browser or a terminal that plays a server's character, a client like any other."""
