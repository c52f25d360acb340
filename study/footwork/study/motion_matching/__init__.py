"""Motion matching, the rival: every tenth of a second it plays on from the frame that best fits pose and wish."""
