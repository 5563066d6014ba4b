// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pago::perf {

// They make the rows of the queue table.
void register_throughput();  ///< SpscQueue, Channel, boost::lockfree::spsc_queue, a ring under a mutex
void register_hand_over();   ///< from a thread to one that sleeps, through a Channel

}  // namespace pago::perf
