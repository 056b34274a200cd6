// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>

#include <span>
#include <string>

namespace asperity {

/// Why the energy of a layer is not accounted for to the last unit, in one line; empty when it is:
/// for every channel
///     rays * 2^32 = escaped + absorbed + truncated + edge
///     escaped = sum of `energy` = sum of `escaped_by_bounce`.
/// The arrays must have the sizes of `shape`; channels go by their `names`, or by number.
std::string imbalance(const Layer& layer, const SumShape& shape,
                      std::span<const std::string> names = {});
/// Throws Error(Account) if there is a reason.
void check_account(const Layer& layer, const SumShape& shape);

namespace io {

/// Edges of the detector are computed anew when a file is read; two mathematics libraries may
/// differ by this much [rad].
inline constexpr double kEdgeTolerance = 1e-12;

/// Why the measurement contradicts itself, in one line; empty when it does not. Looks at the sizes
/// of all arrays, the detector, and the balance of energy of every layer and channel:
///     rays * 2^32 = escaped + absorbed + truncated + edge
///     escaped = sum of `energy` = sum of `escaped_by_bounce`;
/// and for what out_of_range() finds.
std::string contradiction(const Measurement& measurement);

}  // namespace io
}  // namespace asperity
