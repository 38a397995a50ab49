# cmake -DIN=FILE -DNAME=IDENTIFIER -DOUT=FILE -P: a text as a constant of C++.
file(READ ${IN} text)
file(WRITE ${OUT} "#pragma once\n#include <string_view>\ninline constexpr std::string_view ${NAME} = R\"embedded(${text})embedded\";\n")
