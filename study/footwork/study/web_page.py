"""Pages of what was found: HTML files in the style of all plots, for light and dark, that fetch nothing."""

from html import escape
from importlib.resources import files

from footwork.study.plot_style import stylesheet


def web_page(title: str, body: str) -> str:
    """A whole page; ``body`` is HTML."""
    style = (files("footwork.study") / "page.css").read_text(encoding="utf-8")
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>\n{stylesheet()}{style}</style>\n</head>\n"
        f"<body>\n<main>\n{body}\n</main>\n</body>\n</html>\n"
    )
