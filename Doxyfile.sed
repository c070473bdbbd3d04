# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# Doxygen takes `double a, b;  ///< words` as words about b alone: one declaration for each name. Reads a whole file (sed -z).

# Words that go on in the next line.
:words
s|(///<[^\n]*)\n *///<|\1|
t words

# The first of several names gets its own line, until none has company: indent, type, name with initialiser, the others, words.
:names
s|\n( *)([A-Za-z_0-9:]+(<[^<>\n]*>)?) ([a-z_0-9]+( = [^,;\n]+\|\{\})?), ([^;\n]+);([^\n]*)|\n\1\2 \4;\7\n\1\2 \6;\7|
t names
