"""The exceptions of every part: one root, so that a caller can catch what footwork raises and nothing else."""


class FootworkError(Exception):
    """The root of every exception that footwork raises on purpose."""


class InputError(FootworkError):
    """Something from outside (a file, an option) is wrong; the message says what, where and what is valid.

    Args:
        problem: what is wrong, and what would have been valid.
        where: the place, such as ``walk.bvh:12`` or ``--threshold``.
    """

    def __init__(self, problem: str, where: object = "") -> None:
        super().__init__(f"{where}: {problem}" if where else problem)
        self.problem = problem
        self.where = str(where)
