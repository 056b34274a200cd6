// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "command_line.h"
