// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// A parameter of a format of BSDFs, "n" in "rgl:n=64".
struct FormatOption {
    std::string name;
    std::string otherwise;  ///< value when it is not given; empty: chosen from the data
    std::string doc;        ///< one sentence: unit, range, what an empty value means
};

/// Values for the options of a format. Every getter throws Error(Usage, name) for a value it cannot
/// take.
class FormatOptions {
  public:
    /// `text` is "key=value,key=value" or empty. Throws Error(Usage, key) for a key that is not
    /// among `known`, one given twice or a piece without "=".
    FormatOptions(const std::vector<FormatOption>& known, std::string_view text);

    /// The value as it stands; empty when there is neither one nor a default.
    const std::string& text(const std::string& name) const;
    /// A whole number in [least, most], or `otherwise` where there is none.
    int count(const std::string& name, int least, int most, int otherwise) const;
    double number(const std::string& name, double least, double most, double otherwise) const;
    /// One of these words; the first where there is none.
    std::string word(const std::string& name, const std::vector<std::string>& words) const;

  private:
    std::map<std::string, std::string> values_;
};

}  // namespace asperity::io
