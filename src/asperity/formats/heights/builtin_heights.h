// SPDX-License-Identifier: Apache-2.0
// One function per format of heights, each in its own file; builtin_heights.cpp is the table.
#pragma once

#include <asperity/formats/heights/heights_format.h>

#include <span>

namespace asperity::io {

HeightsFormat al3d_format();
HeightsFormat bcr_format();
HeightsFormat esri_format();
HeightsFormat exr_format();
HeightsFormat gsf_format();
HeightsFormat gwy_format();
HeightsFormat matrix_format();
HeightsFormat metropro_format();
HeightsFormat mnt_format();
HeightsFormat nanoscope_format();
HeightsFormat nms_format();
HeightsFormat npy_format();
HeightsFormat opd_format();
HeightsFormat park_tiff_format();
HeightsFormat plu_format();
HeightsFormat plux_format();
HeightsFormat png_format();
HeightsFormat sdf_format();
HeightsFormat spip_format();
HeightsFormat sur_format();
HeightsFormat text_format();
HeightsFormat tiff_format();
HeightsFormat tmd_format();
HeightsFormat x3p_format();
HeightsFormat xyz_format();

/// Whether a TIFF has the tags of Park Systems in what is there of it.
bool has_park_tags(std::span<const std::byte> bytes);

/// HeightsFormat::open of a file that holds one surface and was read whole.
std::vector<HeightsChannel> one_surface(Topography topography);
/// The same for a reader of such files.
template <Topography (*Read)(const HeightsSource&)>
std::vector<HeightsChannel> open_one(const HeightsSource& source) {
    return one_surface(Read(source));
}

/// The samples of a format that knows 32-bit floats; NaN is a missing point.
Topography as_topography(const Heightfield& surface);

}  // namespace asperity::io
