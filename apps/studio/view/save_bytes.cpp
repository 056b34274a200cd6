// SPDX-License-Identifier: Apache-2.0
#include "save_bytes.h"

#include <asperity/formats/atomic_file.h>

#include <QBuffer>
#include <QFile>

#include <string_view>

namespace asperity::studio {

QByteArray png_bytes(const QImage& image) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    image.save(&buffer, "PNG");
    return bytes;
}

void save_bytes(const QByteArray& bytes, const QString& path) {
    io::AtomicFile file(QFile::encodeName(path).toStdString());
    file.write(std::string_view(bytes.constData(), static_cast<std::size_t>(bytes.size())));
    file.commit();
}

}  // namespace asperity::studio
