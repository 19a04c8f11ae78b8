#include "compiler/cli/commands.h"

int main(int argc, char** argv) { return orbc::cli::run(argc, argv); }
