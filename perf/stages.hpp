// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drive.hpp"

namespace pago::perf {

// One per stage, each in its own file; they make the rows of the table. The drive must outlive the run.
void register_decode(const Drive& drive);    ///< check and decode, nothing else
void register_ingest(const Drive& drive);    ///< packets to sweeps: all that the ingest thread does
void register_ground(const Drive& drive);    ///< every method
void register_features(const Drive& drive);  ///< clusters; clusters and features
void register_odometry(const Drive& drive);  ///< odometry, mapping, and what both do afterwards
void register_whole(const Drive& drive);     ///< packets to poses

}  // namespace pago::perf
