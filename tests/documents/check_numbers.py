"""check_numbers.py ROOT PROGRAM: every number in README.md and ARCHITECTURE.md is accounted for in numbers.txt.

numbers.txt has a document's name at the line's start; indented by two, words of that document with each number in
braces; and indented by four, where the numbers come from:
    source FILE REGEX        the regex, met once in a file of the sources, has the numbers as its groups
    run ARGUMENTS => REGEX   likewise in what the program prints
    marked COMMAND           measured: the paragraph names the command that prints it
    means WORDS              no finding: part of a name, or of what a term means
Looked at are digits and number words in prose and tables. Numbers in code (`...`, blocks) are what a reader types, and
a list's own numbers count nothing.
"""
import re
import shlex
import subprocess
import sys
from pathlib import Path

DOCUMENTS = ("README.md", "ARCHITECTURE.md")
WORDS = {word: value for value, word in enumerate(
    "zero one two three four five six seven eight nine ten eleven twelve".split()) if value > 1}
NUMBER = re.compile(r"(?:(?<![\w.])|(?<=\dx))\d+(?:[.,]\d+)*(?:\^-?\d+)?|(?<=[A-Za-z]\.)\d+|\b(?:"
                    + "|".join(WORDS) + r")\b", re.I)


def blanked(match):
    """As long as it was, so that places stay."""
    return re.sub(r"[^\n]", " ", match.group())


def prose_of(text):
    """The document with code, addresses of links and the numbers of lists blanked."""
    for pattern in (r"^```.*?^```", r"^    (?:edgewise|\./|[a-z]+ .*edgewise).*$", r"`[^`\n]*`", r"\]\([^)]*\)",
                    r"^\d+\. (?=\*\*)"):
        text = re.sub(pattern, blanked, text, flags=re.S | re.M if "```" in pattern else re.M)
    return text


def value_of(text):
    text = text.strip().lower().replace(",", "").replace("'", "")
    if text in WORDS:
        return float(WORDS[text])
    if text.startswith("0x"):
        return float.fromhex(text)
    if "/" in text:
        over, _, under = text.partition("/")
        return value_of(over) / value_of(under)
    base, _, power = text.partition("^")
    return float(base) ** int(power) if power else float(base)


def entries_of(table):
    """(document, words, rule); words and rules may go on in lines that are indented further."""
    document, entries = None, []
    for line in table.splitlines():
        body = line.strip()
        if not body or line.startswith("#"):
            continue
        indent = len(line) - len(line.lstrip(" "))
        if indent == 0:
            document = body
        elif indent == 2:
            entries.append([document, body, None])
        elif indent == 4 and entries[-1][2] is None:
            entries[-1][2] = body
        else:
            raise ValueError(f"numbers.txt: {body}")
    return entries


def groups_of(text, regex, where, count):
    """The one match's groups."""
    found = list(re.finditer(regex, text, re.M))
    if len(found) != 1:
        raise ValueError(f"{where}: {len(found)} matches of {regex}")
    if len(found[0].groups()) != count:
        raise ValueError(f"{where}: {regex}: {count} groups are wanted")
    return [value_of(group) for group in found[0].groups()]


def paragraph_at(text, place):
    start, end = text.rfind("\n\n", 0, place), text.find("\n\n", place)
    return " ".join(text[start + 1:end if end >= 0 else len(text)].split())


class Check:
    def __init__(self, root, program, run=subprocess.run):
        self.root, self.program, self.run, self.printed = Path(root), program, run, {}

    def output_of(self, arguments):
        if arguments not in self.printed:
            self.printed[arguments] = self.run([self.program, *shlex.split(arguments)], capture_output=True, text=True,
                                               check=True).stdout
        return self.printed[arguments]

    def derived(self, rule, text, place, count):
        """The numbers that a rule gives; none where it only says why there are none to derive."""
        kind, _, rest = rule.partition(" ")
        if kind == "source":
            file, _, regex = rest.partition(" ")
            return groups_of((self.root / file).read_text(), regex, file, count)
        if kind == "run":
            arguments, _, regex = rest.partition(" => ")
            return groups_of(self.output_of(arguments), regex, f"edgewise {arguments}", count)
        if kind == "marked":
            if f"`{rest}`" not in paragraph_at(text, place):
                raise ValueError(f"the paragraph does not name `{rest}`")
            return None
        if kind == "means" and rest:
            return None
        raise ValueError(f"no rule: {rule}")

    def covered(self, text, words, rule):
        """Places in braces. Throws where they are not what the rule gives."""
        bare = re.sub(r"[{}]", "", words)
        found = list(re.finditer(r"\s+".join(map(re.escape, bare.split())), text))
        if len(found) != 1:
            raise ValueError(f"{len(found)} places have these words")
        stated = re.findall(r"\{([^}]*)\}", words)
        pattern = re.sub(r"\\\{(.*?)\\\}", r"(\1)", r"\s+".join(map(re.escape, words.split())))
        match = re.compile(pattern).match(text, found[0].start())
        derived = self.derived(rule, text, match.start(), len(stated))
        if derived is not None and derived != [value_of(one) for one in stated]:
            raise ValueError(f"{rule}: gives {derived}")
        return {place for i in range(len(stated)) for place in range(*match.span(i + 1))}

    def problems(self, documents, table):
        """What is wrong, a line each."""
        wrong, places = [], {document: set() for document in documents}
        for document, words, rule in entries_of(table):
            try:
                places[document] |= self.covered(documents[document], words, rule or "")
            except (ValueError, KeyError, OSError, subprocess.CalledProcessError) as error:
                wrong.append(f"{document}: {words}: {error}")
        for document, text in documents.items():
            for number in NUMBER.finditer(prose_of(text)):
                if number.start() not in places[document]:
                    line = text.count("\n", 0, number.start()) + 1
                    wrong.append(f"{document}:{line}: {number.group()} is not in numbers.txt: "
                                 + text.splitlines()[line - 1].strip()[:100])
        return wrong


def main(root, program):
    documents = {name: (Path(root) / name).read_text() for name in DOCUMENTS}
    table = (Path(__file__).parent / "numbers.txt").read_text()
    wrong = Check(root, program).problems(documents, table)
    counts = {name: len(list(NUMBER.finditer(prose_of(text)))) for name, text in documents.items()}
    print(", ".join(f"{name}: {count} numbers" for name, count in counts.items()))
    assert all(count > 10 for count in counts.values()), "the numbers were not found"
    return "\n".join(wrong) if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
