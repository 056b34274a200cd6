// SPDX-License-Identifier: Apache-2.0
// How the product's speed depends on the size of the surface, on threads and on the reflectance,
// and where the time of a whole run goes. docs/performance.md says what is measured.
#include "product_tasks.h"
#include "program.h"

int main(int argc, char** argv) {
    using namespace asperity::bench;
    return guarded_main("product_bench", [&] {
        return run_tasks("Speed of whole measurements",
                         {add_growth, add_threads, add_fresnel, add_around, add_stages}, "", argc,
                         argv);
    });
}
