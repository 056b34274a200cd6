// SPDX-License-Identifier: Apache-2.0
// The formats of pictures in linear light, each in a file of its own: the rows of image_formats().
#pragma once

#include <asperity/formats/images/image_format.h>

namespace asperity::io::detail {

ImageFormat exr_format();
ImageFormat hdr_format();

}  // namespace asperity::io::detail
