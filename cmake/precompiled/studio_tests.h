// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtTest>
#include <QtWidgets>
#include "library.h"
