// SPDX-License-Identifier: Apache-2.0
#include <asperity/params/suggest.h>

#include <algorithm>
#include <cstddef>

namespace asperity {

namespace {

/// Optimal string alignment distance: Levenshtein's, with a swap of neighbours counted once.
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

constexpr std::size_t kLongestName = 64;

}  // namespace

std::string nearest(const std::string& typed, const std::vector<std::string>& names) {
    if (typed.size() > kLongestName) return {};
    std::string best;
    std::size_t best_distance = std::max<std::size_t>(2, typed.size() / 3) + 1;
    for (const std::string& name : names) {
        // The beginning of a name is as good as one wrong letter.
        const bool begins = typed.size() >= 3 && name.compare(0, typed.size(), typed) == 0;
        const std::size_t d = begins ? 1 : distance(typed, name);
        if (d < best_distance && d < name.size()) {
            best = name;
            best_distance = d;
        }
    }
    return best;
}

std::string did_you_mean(const std::string& typed, const std::vector<std::string>& names) {
    const std::string name = nearest(typed, names);
    return name.empty() ? std::string() : "; did you mean " + name + "?";
}

}  // namespace asperity
