/* SPDX-FileCopyrightText: 2026 The PaGO authors
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Poses for other processes, in plain C: how they lie in shared memory, and what a datagram of them holds.
 * The layout of version 1 never changes; later versions get a name of their own. Little-endian, no padding.
 */
#ifndef PAGO_OUTPUT_POSE_V1_H_
#define PAGO_OUTPUT_POSE_V1_H_

#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { PAGO_POSE_V1 = 0x31504750 /* "PGP1" */ };

/* Which of a sweep's two poses: the early one, or the one that scan-to-map refined milliseconds later. */
enum { PAGO_POSE_FIRST = 1, PAGO_POSE_REFINED = 2 };

/* Trust in the pose. Do not drive on a LOST one. */
enum { PAGO_HEALTH_INIT = 0, PAGO_HEALTH_OK = 1, PAGO_HEALTH_DEGRADED = 2, PAGO_HEALTH_LOST = 3 };

struct pago_pose_v1 {
  uint32_t magic; /* PAGO_POSE_V1 */
  uint8_t kind;   /* PAGO_POSE_FIRST or _REFINED */
  uint8_t health; /* PAGO_HEALTH_... */
  uint8_t reason; /* of a health other than OK; words: pago::HealthReason */
  uint8_t reserved;
  uint64_t sequence;       /* of the sweep: counts rotations of the head, also those without a pose */
  int64_t stamp_ns;        /* the instant that the pose holds for: time of day, ns since the Unix epoch */
  int64_t last_arrival_ns; /* when the sweep's last packet reached this host: CLOCK_REALTIME */
  int64_t published_ns;    /* when this was written: CLOCK_REALTIME */
  char frame_id[16];       /* the frame that the pose is given in: "odom" (REP-105) */
  char child_frame_id[16]; /* whose pose it is: "base_link" or "sensor" */
  double position_m[3];
  double orientation_xyzw[4]; /* unit quaternion, rotates child to frame */
  double twist[6];            /* of the child, in the child's frame: x y z in m/s, roll pitch yaw in rad/s */
  /* Of the motion since the last sweep, row by row, order x y z roll pitch yaw, in the child's frame; m^2,
   * m rad, rad^2. */
  double covariance[36];
};

/* The newest pose of one kind: odd versions are being written, 0 holds nothing yet. */
struct pago_pose_slot_v1 {
  uint64_t version;
  uint64_t words[sizeof(struct pago_pose_v1) / 8];
};

/* What lies in the shared memory /dev/shm/NAME (setting publish.shared_memory). */
struct pago_pose_board_v1 {
  uint32_t magic; /* PAGO_POSE_V1, written last: anything else is no board, or not ready */
  uint32_t news;  /* grows by one with each pose; a futex word, woken (not FUTEX_PRIVATE_FLAG) each time */
  struct pago_pose_slot_v1 first;
  struct pago_pose_slot_v1 refined;
};

/* Copies a slot's pose. 1: done; 0: there is none yet, or it is being written just now (try again). */
static inline int pago_read_pose_v1(const struct pago_pose_slot_v1* slot, struct pago_pose_v1* pose) {
  uint64_t words[sizeof(struct pago_pose_v1) / 8];
  const uint64_t before = __atomic_load_n(&slot->version, __ATOMIC_ACQUIRE);
  unsigned i;
  if (before == 0 || before % 2 != 0) return 0;
  for (i = 0; i < sizeof(words) / 8; ++i) words[i] = __atomic_load_n(&slot->words[i], __ATOMIC_ACQUIRE);
  if (__atomic_load_n(&slot->version, __ATOMIC_RELAXED) != before) return 0;
  memcpy(pose, words, sizeof(*pose));
  return 1;
}

#ifdef __cplusplus
}
#endif

#endif /* PAGO_OUTPUT_POSE_V1_H_ */
