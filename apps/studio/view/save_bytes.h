// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QByteArray>
#include <QImage>
#include <QString>

namespace asperity::studio {

QByteArray png_bytes(const QImage& image);

/// Writes a file, whole or not at all. Throws Error(InputOutput, path).
void save_bytes(const QByteArray& bytes, const QString& path);

}  // namespace asperity::studio
