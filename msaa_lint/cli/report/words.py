"""Numbers with nouns."""


def plural(n: int, word: str) -> str:
    """`1 pass`, `2 passes`, `2 more files`."""
    return (
        f"{n} {word}"
        if n == 1
        else f"{n} {word}es"
        if word.endswith(("s", "ch"))
        else f"{n} {word}s"
    )
