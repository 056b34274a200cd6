// SPDX-License-Identifier: Apache-2.0
#include "brdf_argument.h"

#include "file_kind.h"

#include <asperity/bsdf/bsdf_models.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/params/suggest.h>

#include <filesystem>
#include <string>
#include <vector>

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
    std::vector<std::string> names;
    for (const BsdfModel& model : bsdf_models()) names.push_back(model.name);
    std::string meant = did_you_mean(text.substr(0, text.find(':')), names);
    if (meant.empty()) meant = did_you_mean_file(text);
    throw Error(ErrorCode::InputOutput,
                "there is no such file, and no such model (" + bsdf_model_names() + ")" + meant,
                text);
}

}  // namespace asperity::cli
