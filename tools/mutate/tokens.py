"""Splits C++ into tokens: as much of the language as finding operators needs."""

import re
from dataclasses import dataclass

TOKEN = re.compile(r"""
    (?P<comment>//(?:[^\n\\]|\\.)*|/\*.*?\*/)
  | (?P<directive>^[ \t]*\#(?:[^\n\\]|\\.)*)
  | (?P<string>(?:u8|[uUL])?(?:R"(?P<end>[^()\\\s]{0,16})\(.*?\)(?P=end)"|"(?:[^"\\\n]|\\.)*"))
  | (?P<character>(?:u8|[uUL])?'(?:[^'\\\n]|\\.)+')
  | (?P<number>\.?\d(?:[eEpP][+-]|'(?=\w)|[\w.])*)
  | (?P<word>[A-Za-z_]\w*)
  | (?P<operator><=>|<<=|>>=|->\*|\.\.\.|::|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|[^\w\s])
""", re.VERBOSE | re.DOTALL | re.MULTILINE)


@dataclass(frozen=True)
class Token:
    kind: str  # a group of TOKEN
    text: str
    start: int  # offset in the file

    @property
    def end(self):
        return self.start + len(self.text)


def tokens_of(source):
    """Tokens of the code: without comments and preprocessor lines."""
    return [Token(match.lastgroup if match.lastgroup != "end" else "string", match.group(), match.start())
            for match in TOKEN.finditer(source) if match.lastgroup not in ("comment", "directive")]
