"""Includes that a source does not need.

    includes.py SOURCE

A .c file of src/ that includes a header uses something that the header itself declares or defines. The header of the same name is
always included, so that the compiler compares both. Prints one line for each include that is not needed.
"""
import os
import re
import sys

# What the standard headers declare, as far as src/ uses it; other system headers are not checked.
STANDARD = {
    "float.h": r"(DBL|FLT)_\w+",
    "limits.h": r"(CHAR|S?CHAR|SHRT|INT|UINT|LONG|ULONG|LLONG|ULLONG)_(MAX|MIN|BIT)",
    "math.h": r"INFINITY|NAN|isfinite|isnan|isinf|signbit|fabs|sqrt|hypot|floor|ceil|ldexp|frexp|nextafter|fma|fmin|fmax|cos|sin|tan"
    r"|atan2?|acos|asin|exp2?|log2?|pow|rint|l?l?round|trunc|copysign|fmod|scalbn|ilogb|logb|cbrt|nearbyint|l?lrint|remainder|M_PI",
    "stdbool.h": r"bool|true|false",
    "stdint.h": r"u?int(8|16|32|64|ptr|max)_t|U?INT(8|16|32|64|PTR|MAX)_(MAX|MIN|C)|U?INT64_C|SIZE_MAX",
    "stdlib.h": r"qsort|bsearch|malloc|free|calloc|realloc|l?l?abs|strto\w+|ato[ifl]|getenv|exit|abort",
    "string.h": r"mem(cpy|move|set|cmp|chr)|str(len|n?cmp|r?chr|str|n?cpy|n?dup|cat|c?spn|error)\w*",
}


def read(path):
    with open(path, encoding="utf-8") as file:
        return re.sub(r"/\*.*?\*/", "", file.read(), flags=re.DOTALL)


def declared(path):
    """Names that a header of the project declares or defines."""
    text = re.sub(r"^#include.*$", "", read(path), flags=re.MULTILINE)
    return set(re.findall(r"\b(?:sunder|SUNDER)_\w+", text)) | set(re.findall(r"#\s*define\s+(\w+)", text))


def main(root):
    known, wrong = {}, 0
    for folder, _, names in os.walk(root):
        for name in sorted(n for n in names if n.endswith(".c")):
            path = os.path.relpath(os.path.join(folder, name), root)
            text = read(os.path.join(root, path))
            code = re.sub(r"^#include.*$", "", text, flags=re.MULTILINE)
            used = set(re.findall(r"\w+", code))
            for kind, header in re.findall(r'^#include\s+([<"])([^>"]+)[>"]', text, flags=re.MULTILINE):
                if kind == "<":
                    needed = header not in STANDARD or re.search(rf"\b({STANDARD[header]})\b", code)
                else:
                    if header not in known:
                        known[header] = declared(os.path.join(root, header))
                    needed = header[:-2] == path[:-2] or known[header] & used
                if not needed:
                    print(f"{path} does not need {header}")
                    wrong += 1
    return wrong


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]) > 0)
