// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pago::simulator {

/// What lines a world's streets, plot by plot. Chances are per slot of the thing in question.
struct Town {
  double plots = 1.0;      ///< of the land along streets, built on or closed off
  double house = 0.7;      ///< of plots that have one
  double gap = 0.5;        ///< of houses with a gap beside them
  double set_back = 0.45;  ///< of houses that stand behind a front garden
  int low_storeys = 2, high_storeys = 5;
  bool has_furniture = true;  ///< lamps, signs, bins, and trees where a street is lined with them
  double tree_lined = 0.5;    ///< of street sides
  double parked = 0.5;        ///< of kerb slots on the average street; each street has its own
};

/// What lines a road through the country, in stretches of 30 to 90 m on either side of it.
struct Roadside {
  double hedge = 0.0, wire_fence = 0.0, tree_row = 0.0, poles = 0.0, noise_wall = 0.0;  ///< parts of it
  double near_m = 3.5, far_m = 7.0;  ///< where, from the carriageway's edge
  double guard_rail = 0.0;           ///< another part, close to the edge; always where a median is
  double post_every_m = 0.0;         ///< delineators; 0: none
  double tall_grass = 0.0;           ///< tufts per 2 m
  double bridge_every_m = 0.0;       ///< across it; 0: none
  bool is_tunnel = false;
};

/// What stands in the land beyond.
struct Land {
  double tree = 0.16;  ///< per 7 m square off the streets; as many bushes
  double wood = 0.0;   ///< the same within woods, which cover a fifth of the land
};

struct Scenery {
  Town town;
  Roadside roadside;
  Land land;
  double marking_left_m = 0.0;  ///< of a carriageway's middle
  bool is_marked = true;
};

}  // namespace pago::simulator
