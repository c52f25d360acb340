"""One file a table, figure or statement: each holds a ``ROW`` (``footwork.study.reproduction.row.Row``)."""
