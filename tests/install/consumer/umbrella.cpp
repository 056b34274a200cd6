// SPDX-License-Identifier: Apache-2.0
// All public headers at once: their names get along, and what they include is installed.
#include <asperity/asperity.h>

asperity::Model knot_of_models() {
    return {};
}
