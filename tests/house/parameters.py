"""Compares the names of parameters in the prototypes of headers with those in the definitions.

parameters.py ROOT TREE...: prints one line for each function whose names differ, or whose prototype has a parameter
without a name, and the number of prototypes that were compared. The sources are read as text: everything between
braces is removed, and in the rest each declarator with a list of parameters is a function.
"""
import os
import re
import sys

NOISE = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.S)
DIRECTIVE = re.compile(r'^[ \t]*#(?:[^\n]*\\\n)*[^\n]*', re.M)
ATTRIBUTE = re.compile(r'__attribute__\s*\(\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)\)')
WORD = re.compile(r'[A-Za-z_]\w*')
FUNCTION = re.compile(r'([A-Za-z_]\w*)\s*\((.*)\)\s*$', re.S)


def outside_braces(text):
    """The declarations of a file: pairs of a text and whether a body in braces follows it."""
    text = text.replace('extern "C" {', '')
    text = ATTRIBUTE.sub(' ', DIRECTIVE.sub(' ', NOISE.sub(' ', text)))
    depth, begin = 0, 0
    for at, c in enumerate(text):
        if c == '{':
            if depth == 0:
                yield text[begin:at], True
            depth += 1
        elif c == '}':
            depth = max(0, depth - 1)
            begin = at + 1
        elif c == ';' and depth == 0:
            yield text[begin:at], False
            begin = at + 1


def split_list(text):
    """The parameters: split at commas that are not inside parentheses or brackets."""
    part, depth, begin = [], 0, 0
    for at, c in enumerate(text):
        depth += (c in '([') - (c in ')]')
        if c == ',' and depth == 0:
            part.append(text[begin:at])
            begin = at + 1
    return part + [text[begin:]]


def parameter_name(text):
    """The name of a parameter, or '' if it has none."""
    pointer = re.search(r'\(\s*\*\s*(?:const\s+)?(\w*)\s*(?:\[[^]]*\]\s*)?\)\s*\(', text)
    if pointer:
        return pointer.group(1)
    text = re.sub(r'\[[^]]*\]', ' ', text).strip()
    words = [w for w in WORD.findall(text) if w not in ('const', 'restrict', 'volatile', 'struct', 'enum', 'union')]
    return words[-1] if len(words) > 1 and not text.endswith('*') else ''


def parameters(text):
    """(name of the function, names of its parameters), or None if the text does not declare a function."""
    if re.match(r'\s*(typedef|return)\b', text) or '=' in text:
        return None
    # The list is the last pair of parentheses, which closes at the end of the text.
    text = text.rstrip()
    if not text.endswith(')'):
        return None
    depth = 0
    for at in range(len(text) - 1, -1, -1):
        depth += (text[at] == ')') - (text[at] == '(')
        if depth == 0:
            break
    name = re.search(r'([A-Za-z_]\w*)\s*$', text[:at])
    if not name or not WORD.search(text[:name.start()]):
        return None
    inside = text[at + 1:-1].strip()
    if inside in ('', 'void'):
        return name.group(1), []
    return name.group(1), ['...' if p.strip() == '...' else parameter_name(p) for p in split_list(inside)]


def sources(tree, end):
    for folder, _, files in sorted(os.walk(tree)):
        for file in sorted(files):
            if file.endswith(end):
                yield os.path.join(folder, file)


def functions(path, with_body):
    with open(path, encoding='utf-8') as f:
        for text, body in outside_braces(f.read()):
            found = parameters(text) if body == with_body else None
            if found:
                yield found


def main(root, trees):
    wrong = compared = 0
    for tree in trees:
        defined = {}
        for path in sources(os.path.join(root, tree), '.c'):
            for name, names in functions(path, True):
                defined.setdefault(name, []).append((names, os.path.relpath(path, root)))
        for path in sources(os.path.join(root, tree), '.h'):
            for name, names in functions(path, False):
                if '' in names:
                    print(f'{os.path.relpath(path, root)}: {name}({", ".join(names)}) leaves a parameter without a name')
                    wrong += 1
                for own, file in defined.get(name, []):
                    compared += 1
                    if own != names:
                        print(f'{os.path.relpath(path, root)}: {name}({", ".join(names)}), '
                              f'but in {file} {name}({", ".join(own)})')
                        wrong += 1
    print(f'{compared} prototypes compared, {wrong} differ')
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1], sys.argv[2:]))
