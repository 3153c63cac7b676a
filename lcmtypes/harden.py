#!/usr/bin/env python3
"""Makes what lcm-gen wrote safe against hostile messages.

    harden.py RAW_DIRECTORY OUTPUT_DIRECTORY FILE.lcm...

The C++ decoder of lcm-gen 1.3.1 believes every length that it reads: a huge one crashes or eats gigabytes, a negative one
throws. This guards each length by what the rest of the message can hold, refuses strings that are not terminated exactly
once and booleans other than 0 and 1, and gives every number a default of 0. A generated file in which a guard does not find
its place is an error, so another version of lcm-gen cannot slip through unguarded. Unchanged files are left alone.
"""

import pathlib
import re
import sys

SIZES = {"int8_t": 1, "byte": 1, "boolean": 1, "int16_t": 2, "int32_t": 4, "int64_t": 8, "float": 4, "double": 8, "string": 5}
STRUCT = re.compile(r"package\s+(\w+)\s*;.*?struct\s+(\w+)\s*\{(.*)\}", re.S)
FIELD = re.compile(r"(\w+)\s+(\w+)\s*(?:\[\s*(\w+)\s*\])?\s*;")
CHECKED = r"\n    if\(tlen < 0\) return tlen; else pos \+= tlen;\n"


class Type:
    """A struct of one .lcm file: its fields as (type, name, array length or None)."""

    def __init__(self, path):
        text = re.sub(r"//[^\n]*", "", path.read_text())
        package, self.name, body = STRUCT.search(text).groups()
        body = re.sub(r"const\s[^;]*;", "", body)
        self.fields = [(f[0], f[1], f[2] or None) for f in FIELD.findall(body)]
        self.header = pathlib.Path(package) / f"{self.name}.hpp"


def least_size(type_name, types):
    """Least number of bytes that a value of this type takes on the wire."""
    if type_name in SIZES:
        return SIZES[type_name]
    return sum(
        least_size(field_type, types) * (int(length) if length.isdigit() else 0) if length else least_size(field_type, types)
        for field_type, _, length in types[type_name].fields
    )


def replace_once(text, pattern, replacement, what):
    text, count = re.subn(pattern, replacement, text)
    if count != 1:
        sys.exit(f"harden.py: {what}: lcm-gen wrote this {count} times instead of once; the guards do not fit its version")
    return text


def harden(text, message, types):
    for field_type, name, length in message.fields:
        what = f"{message.name}.{name}"
        if length and not length.isdigit():
            size = least_size(field_type, types)
            resize = rf"this->{name}\.resize\(this->{length}\);"
            guard = f"if(this->{length} < 0 || this->{length} > (maxlen - pos) / {size}) return -1;\n    "
            text = replace_once(text, resize, lambda match: guard + match.group(0), what)
        elif length:
            sys.exit(f"harden.py: {what}: arrays of fixed length are not provided for")
        elif field_type == "string":
            size = f"__{name}_len__"
            start = "(const char*)buf + offset + pos"
            guard = (
                f"if({size} < 1 || {size} > maxlen - pos) return -1;\n"
                f"    if(memchr({start}, 0, {size}) != {start} + {size} - 1) return -1;"
            )
            text = replace_once(text, rf"if\({size} > maxlen - pos\) return -1;", lambda _: guard, what)
        elif field_type == "boolean":
            decode = rf"__boolean_decode_array\(buf, offset \+ pos, maxlen - pos, &this->{name}, 1\);{CHECKED}"
            guard = f"    if(this->{name} != 0 && this->{name} != 1) return -1;\n"
            text = replace_once(text, decode, lambda match: match.group(0) + guard, what)
        if field_type in SIZES and field_type != "string" and not length:
            text = replace_once(text, rf"(\n        \w+ +{name});", r"\1 = 0;", what)
    return replace_once(text, r"#include <lcm/lcm_coretypes.h>\n", "#include <lcm/lcm_coretypes.h>\n#include <cstring>\n", message.name)


def main():
    raw, output = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    messages = [Type(pathlib.Path(path)) for path in sys.argv[3:]]
    types = {message.name: message for message in messages}
    for message in messages:
        text = harden((raw / message.header).read_text(), message, types)
        target = output / message.header
        target.parent.mkdir(parents=True, exist_ok=True)
        if not target.exists() or target.read_text() != text:
            target.write_text(text)


if __name__ == "__main__":
    main()
