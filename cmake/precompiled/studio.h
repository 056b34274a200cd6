// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets>
#include "library.h"
