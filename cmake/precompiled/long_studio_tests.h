// SPDX-License-Identifier: Apache-2.0
// The same for tests that are optimised, though sanitized.
#pragma once
#include "studio_tests.h"
