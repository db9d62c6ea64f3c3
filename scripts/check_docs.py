#!/usr/bin/python3
"""Fails when a page of the documentation points to nothing: relative links, their headings, pictures, and
paths of this repository written as code (`scripts/test.sh`); and when no page links to a page of docs/.

    check_docs.py                        links and paths
    check_docs.py --program MUDLARK      the case files on the pages, by `MUDLARK check`
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
CODE = re.compile(r"`([^`\n]+)`")
# A code span is taken for a path when it starts with one of these and holds no placeholder.
FOLDERS = ("apps/", "src/", "python/", "cases/", "tests/", "benchmarks/", "docs/", "scripts/", "cmake/", ".ci/")
PLACEHOLDER = re.compile(r"[<>*{}$…]|NNNN|NAME|\.\.\.")


def pages():
    yield from sorted(ROOT.glob("*.md"))
    for folder in ("docs", "cases", "benchmarks", "tests", "python"):
        yield from sorted((ROOT / folder).rglob("*.md"))


def without_code_blocks(text):
    """The text with fenced blocks emptied, line numbers kept."""
    inside, lines = False, []
    for line in text.splitlines():
        fence = line.lstrip().startswith("```")
        lines.append("" if inside or fence else line)
        inside ^= fence
    return lines


def anchors(page):
    """Heading anchors of a page, as GitHub and most renderers make them."""
    names = set()
    for line in without_code_blocks(page.read_text()):
        if line.startswith("#"):
            title = line.lstrip("#").strip().lower()
            names.add(re.sub(r"[^\w\- ]", "", title).replace(" ", "-"))
    return names


def problems_of(page):
    for number, line in enumerate(without_code_blocks(page.read_text()), 1):
        place = f"{page.relative_to(ROOT)}:{number}"
        for target in LINK.findall(CODE.sub("", line)):
            if re.match(r"[a-z]+:", target):
                continue
            path, _, anchor = target.partition("#")
            linked = (page.parent / path).resolve() if path else page
            if not linked.exists():
                yield f"{place}: link to {target}, which does not exist"
            elif anchor and linked.suffix == ".md" and anchor not in anchors(linked):
                yield f"{place}: link to {target}, which has no such heading"
        for code in CODE.findall(line):
            first = code.split()[0] if code.split() else ""
            if first.startswith(FOLDERS) and not PLACEHOLDER.search(first):
                if not (ROOT / first.rstrip(":,")).exists():
                    yield f"{place}: `{first}` does not exist"


def unreachable(all_pages):
    """Pages of docs/ that no page links to."""
    linked = {ROOT / "docs/index.md"}
    for page in all_pages:
        for line in without_code_blocks(page.read_text()):
            linked |= {(page.parent / target.split("#")[0]).resolve() for target in LINK.findall(line)}
    for page in all_pages:
        if ROOT / "docs" in page.parents and page not in linked:
            yield f"{page.relative_to(ROOT)}: no page links here; add it to docs/index.md"


def case_files(page):
    """Whole case files on a page: TOML blocks with [domain]; in tutorials a block without it continues the last."""
    last = ""
    for block in re.findall(r"^```toml\n(.*?)^```", page.read_text(), re.S | re.M):
        if "[domain]" in block:
            last = block
        elif "tutorials" in page.parts and last:
            last += "\n" + block
        else:
            continue
        yield last


def problems_of_cases(page, program):
    for number, text in enumerate(case_files(page), 1):
        with tempfile.TemporaryDirectory() as folder:
            case = Path(folder) / "case.toml"
            case.write_text(text)
            answer = subprocess.run([program, "check", case], capture_output=True, text=True, cwd=folder)
        if answer.returncode != 0:
            yield f"{page.relative_to(ROOT)}: case file {number}: {answer.stdout}{answer.stderr}"


def main():
    all_pages = list(pages())
    if sys.argv[1:2] == ["--program"]:
        program = Path(sys.argv[2]).resolve()
        subject = f"{sum(len(list(case_files(page))) for page in all_pages)} case files"
        problems = [p for page in all_pages for p in problems_of_cases(page, program)]
    else:
        subject = f"{len(all_pages)} pages"
        problems = [problem for page in all_pages for problem in problems_of(page)]
        problems += unreachable(all_pages)
    for problem in problems:
        print(problem)
    print(f"check_docs: {subject}, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
