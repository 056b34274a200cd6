#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A source has what it uses by its own includes, or by what these include.

Compilers do not show it where sources are compiled together or headers are read beforehand (ASPERITY_UNITY,
ASPERITY_PRECOMPILE): there a file lives on what another one included. Looked for are the names that the
headers of the tree declare outside of classes, and those of the standard library that STANDARD lists.

usage: check_includes.py ROOT      prints one line for each name that nothing brings; exits 1 if there is one
"""

import re
import sys
from functools import cache
from pathlib import Path

STANDARD = {
    "algorithm": "all_of any_of none_of clamp copy copy_n count count_if equal fill fill_n find find_if"
                 " for_each generate lower_bound upper_bound max_element min_element minmax_element"
                 " nth_element partial_sort partition remove_if reverse rotate shuffle sort stable_sort"
                 " transform unique",
    "array": "array", "atomic": "atomic", "bit": "bit_cast bit_ceil bit_width countl_zero countr_zero endian popcount",
    "charconv": "from_chars to_chars", "chrono": "chrono", "cmath": "abs acos asin atan atan2 cbrt ceil cos"
             " cosh erf erfc exp exp2 expm1 floor fmod hypot isfinite isinf isnan lgamma llround log log10"
             " log1p log2 lround nextafter pow round signbit sin sinh sqrt tan tanh tgamma trunc",
    "complex": "complex", "condition_variable": "condition_variable", "cstdlib": "getenv", "cstring":
    "memchr memcmp memcpy memmove memset strchr strcmp strlen", "deque": "deque",
    "exception": "exception current_exception exception_ptr rethrow_exception",
    "filesystem": "filesystem", "fstream": "ifstream", "functional": "function", "future": "async future promise",
    "iterator": "back_inserter ostream_iterator", "limits": "numeric_limits", "map": "map multimap",
    "memory": "make_shared make_unique shared_ptr unique_ptr weak_ptr", "mutex": "lock_guard mutex once_flag"
    " scoped_lock unique_lock", "new": "bad_alloc", "numbers": "numbers", "numeric": "accumulate iota reduce"
    " transform_reduce", "optional": "nullopt optional", "random": "mt19937 mt19937_64",
    "regex": "regex", "set": "set multiset", "span": "span", "sstream": "istringstream ostringstream stringstream",
    "stdexcept": "domain_error invalid_argument logic_error out_of_range runtime_error",
    "string": "stod stoi string to_string", "string_view": "string_view", "system_error": "error_code",
    "thread": "jthread this_thread", "tuple": "apply make_tuple tie tuple", "unordered_map": "unordered_map",
    "unordered_set": "unordered_set", "utility": "exchange pair", "variant": "get_if holds_alternative variant visit",
    "vector": "vector",
}
HEADER_OF = {name: header for header, names in STANDARD.items() for name in names.split()}
STANDARD_NAME = re.compile(r"\bstd::(\w+)")
# What a header of the standard library brings by the standard, or in all its implementations
BRINGS = {"sstream": {"string"}, "fstream": {"string"}, "string": {"string_view"}, "regex": {"string"},
          "filesystem": {"string"}, "mutex": {"system_error"}, "map": {"utility"}, "tuple": {"utility"},
          "unordered_map": {"utility"}, "condition_variable": {"mutex"}, "future": {"mutex", "thread"}}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
# The order matters: a comment may hold a quote, a string what looks like a comment.
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"', re.DOTALL)
TYPE = re.compile(r"^(?:template\s*<[^;{]*>\s*)?(?:class|struct|enum class|enum|union)\s+([A-Z]\w+)"
                  r"(?=[^;]*?\{)", re.MULTILINE)
ALIAS = re.compile(r"^using\s+([A-Z]\w+)\s*=", re.MULTILINE)
CONSTANT = re.compile(r"^inline\s+constexpr\s[^=({;]*?\b(k[A-Z]\w+)\s*[=\[{(]", re.MULTILINE)
# The first word of a name like test::Case, SumShape::kSides or Imf::Box that is no namespace of ours
WORD = re.compile(r"(?<![\w.:>])(?:(?:asperity|bench|cli|detail|io|plots|studio|test)::)*(\w+)")
NAME = re.compile(r"[A-Z]\w+|k[A-Z]\w+")
# Inside of classes and functions, and values of enumerations: such a name is none of those outside
INNER = re.compile(r"\b(?:class|struct|enum|union|using|typename|class \.\.\.)\s+([A-Z]\w+)"
                   r"|\bconst(?:expr)?\s[^;(){}]*?\b(k[A-Z]\w+)\s*[=\[{(]|,\s*(k[A-Z]\w+)\s*[=({]"
                   r"|^[ \t]+(?:\w+ )?([A-Z]\w+)(?=\s*(?:,|=|$|\(|\{))|[{,]\s*([A-Zk]\w+)(?=\s*[,}=])"
                   r"|\bTEST\((\w+)", re.MULTILINE)


def code(path):
    return NOT_CODE.sub(lambda m: '""' if m.group().endswith('"') else " ", path.read_text(encoding="utf-8"))


class Tree:
    """The sources and headers below ROOT, and which header declares what."""

    def __init__(self, root):
        self.root = root
        files = [p for folder in ("src", "apps", "tests", "bench", "examples")
                 for p in sorted((root / folder).rglob("*")) if p.suffix in (".h", ".cpp")]
        self.text = {path: path.read_text(encoding="utf-8") for path in files}
        self.declares = {}  # name -> headers
        for path in files:
            if path.suffix == ".h":
                for name in self.declared(path):
                    self.declares.setdefault(name, set()).add(path)

    @cache
    def code(self, path):
        return code(path)

    @cache
    def declared(self, path):
        text = self.code(path)
        return {m.group(1) for pattern in (TYPE, ALIAS, CONSTANT) for m in pattern.finditer(text)}

    @cache
    def inner(self, path):
        return {name for match in INNER.finditer(self.code(path)) for name in match.groups() if name}

    def place_of(self, include, path):
        """The file of the tree that an include of `path` means; None for another library's."""
        for folder in (path.parent, self.root / "src", self.root / "apps", self.root / "apps/studio",
                       self.root / "tests/fuzz"):
            found = (folder / include).resolve()
            if found in self.text:
                return found
        return None

    def may_bring(self, header, path):
        """Whether it is the header of a library that `path` could use."""
        library = self.root / "src"
        return library in header.parents or library not in path.parents

    @cache
    def closure(self, path):
        """All files of the tree, and names of other headers, that come with `path`."""
        seen, todo = set(), [path]
        while todo:
            file = todo.pop()
            for include in INCLUDE.findall(self.text[file]):
                place = self.place_of(include, file) or include
                if place not in seen:
                    seen.add(place)
                    if place in self.text:
                        todo.append(place)
        for header in [name for name in seen if name in BRINGS]:
            seen |= BRINGS[header]
        return frozenset(seen)

    def missing(self, path):
        """Names that `path` uses and nothing brings, with the headers that would."""
        brought, text = self.closure(path), self.code(path)
        known = self.inner(path).union(*(self.inner(file) for file in brought if file in self.text))
        for name in sorted(set(filter(NAME.fullmatch, WORD.findall(text))) - known - self.declared(path)):
            headers = {h for h in self.declares.get(name, ()) if self.may_bring(h, path)}
            if headers and not headers & brought:
                yield name, " or ".join(str(h.relative_to(self.root)) for h in sorted(headers))
        for name in sorted(set(STANDARD_NAME.findall(text))):
            header = HEADER_OF.get(name)
            if header and header not in brought:
                yield f"std::{name}", f"<{header}>"


def check(root):
    tree = Tree(root.resolve())
    complaints = [f"{path.relative_to(tree.root)}: {name} needs {header}"
                  for path in tree.text for name, header in tree.missing(path)]
    return complaints, len(tree.text)


def main():
    complaints, read = check(Path(sys.argv[1]))
    print(*complaints, sep="\n", end="\n" if complaints else "")
    print(f"{read} files, {len(complaints)} names that nothing brings")
    return 1 if complaints or read == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
