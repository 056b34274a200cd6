// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace asperity::cli {

/// Verbs that are programs of their own, as git has them: where the first argument is a word, and a
/// program asperity-WORD lies beside this one or on PATH, becomes that program, with the arguments
/// that follow. Returns where there is none. The Python package brings asperity-sweep.
void become_program_beside(int argc, char** argv);

}  // namespace asperity::cli
