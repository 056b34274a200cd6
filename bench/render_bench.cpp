// SPDX-License-Identifier: Apache-2.0
// How fast the model scene is drawn, and how much noise is left. docs/performance.md says what is
// measured.
#include "program.h"
#include "render_tasks.h"

int main(int argc, char** argv) {
    using namespace asperity::bench;
    return guarded_main("render_bench", [&] {
        return run_tasks("Speed of the renderer, as ratios",
                         {add_frame, add_rays, add_shade, add_variance}, "render_", argc, argv);
    });
}
