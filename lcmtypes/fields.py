#!/usr/bin/env python3
"""Writes <skein/fields.hpp>, by which a program goes through the fields of any message without knowing its type.

    fields.py OUTPUT_DIRECTORY FILE.lcm...

VisitFields(message, visit) calls visit(name, value) for each field in the order of its .lcm file: a bool, a number, a
std::string, another message, or a std::vector of these. Fields that only tell how long an array is are left out.
ForEachMessageType(visit) calls visit.template operator()<T>() for each type. An unchanged file is left alone.
"""

import pathlib
import sys

from harden import Type

HEAD = """\
#pragma once

// Made from the .lcm files by lcmtypes/fields.py, which says what this is.

"""


def visitor(message):
    lengths = {length for _, _, length in message.fields if length}
    lines = []
    for field_type, name, length in message.fields:
        if name in lengths:
            continue
        if field_type == "boolean" and length:
            sys.exit(f"fields.py: {message.name}.{name}: arrays of booleans are not provided for")
        value = f"message.{name} != 0" if field_type == "boolean" else f"message.{name}"
        lines.append(f'  visit("{name}", {value});\n')
    body = "".join(lines)
    return f"template <typename Visit>\nvoid VisitFields(const {message.name}& message, Visit&& visit) {{\n{body}}}\n\n"


def main():
    target = pathlib.Path(sys.argv[1]) / "skein" / "fields.hpp"
    messages = [Type(pathlib.Path(path)) for path in sys.argv[2:]]
    text = HEAD + "".join(f"#include <{message.header}>\n" for message in messages) + "\nnamespace skein {\n\n"
    text += "".join(visitor(message) for message in messages)
    text += "template <typename Visit>\nvoid ForEachMessageType(Visit&& visit) {\n"
    text += "".join(f"  visit.template operator()<{message.name}>();\n" for message in messages)
    text += "}\n\n}  // namespace skein\n"
    if not target.exists() or target.read_text() != text:
        target.write_text(text)


if __name__ == "__main__":
    main()
