// SPDX-License-Identifier: Apache-2.0
#include "brdf_argument.h"

#include <asperity/bsdf/bsdf_models.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>

#include <filesystem>

namespace asperity::cli {

std::unique_ptr<Bsdf> open_brdf(const std::string& text, const io::BsdfFormats& formats) {
    constexpr std::string_view kFile = "file:";
    if (text.starts_with(kFile)) return formats.read(text.substr(kFile.size()));
    if (is_brdf_spec(text)) return parse_brdf_spec(text);
    return formats.can_read(text) ? formats.read(text) : nullptr;
}

void check_brdf_exists(const std::string& text) {
    std::error_code ignored;
    if (text.starts_with("file:") || is_brdf_spec(text) || std::filesystem::exists(text, ignored))
        return;
    throw Error(ErrorCode::InputOutput,
                "there is no such file, and no such model (" + bsdf_model_names() + ")", text);
}

}  // namespace asperity::cli
