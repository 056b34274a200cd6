// SPDX-License-Identifier: Apache-2.0
#include "brdf_source.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/results/result_file.h>

#include <filesystem>
#include <utility>

namespace asperity::studio {

OpenedBrdf open_brdf(const BrdfSource& source, std::shared_ptr<const Measurement> drawn) {
    switch (source.kind) {
        case BrdfSource::Kind::Drawn:
            if (drawn == nullptr)
                throw Error(ErrorCode::Usage, "nothing is drawn yet: Draw To Textures first");
            return drawn;
        case BrdfSource::Kind::Model:
            return std::shared_ptr<const Bsdf>(parse_brdf_spec(source.text));
        case BrdfSource::Kind::File:
            break;
    }
    if (source.text.empty()) throw Error(ErrorCode::Usage, "choose a file first");
    const io::BsdfFormats formats;
    if (formats.can_read(source.text))
        return std::shared_ptr<const Bsdf>(formats.read(source.text));
    return std::make_shared<const Measurement>(io::load_measurement(source.text));
}

std::string name_of(const BrdfSource& source) {
    if (source.kind == BrdfSource::Kind::Drawn) return "the layers drawn";
    if (source.kind == BrdfSource::Kind::Model) return source.text;
    return std::filesystem::path(source.text).filename().string();
}

}  // namespace asperity::studio
