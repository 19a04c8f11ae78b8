# Writes OUTPUT, a C++ source with the bytes of FILE as the function NAME of compiler/cli/embedded.h.
file(READ ${FILE} bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(0x0a,)" "\\1\n" bytes "${bytes}")  # a line for each of the text
file(WRITE ${OUTPUT} "// Made by cmake/embed.cmake.
#include \"compiler/cli/embedded.h\"

namespace orbc::cli {

static const unsigned char k_${NAME}[] = {
${bytes}};

std::string_view ${NAME}() { return {reinterpret_cast<const char*>(k_${NAME}), sizeof k_${NAME}}; }

}  // namespace orbc::cli
")
