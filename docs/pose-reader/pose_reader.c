/* SPDX-FileCopyrightText: 2026 The PaGO authors
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Prints each refined pose that a live pago publishes: pose_reader [NAME]. Build: cc -O2 -I include
 * pose_reader.c
 */
#include <fcntl.h>
#include <linux/futex.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "pago/output/pose_v1.h"

int main(int argc, char** argv) {
  char path[256];
  const struct timespec second = {1, 0};
  const struct pago_pose_board_v1* board;
  struct pago_pose_v1 pose;
  struct timespec now;
  uint64_t last = UINT64_MAX;
  int fd;
  snprintf(path, sizeof path, "/dev/shm/%s", argc > 1 ? argv[1] : "pago");
  while ((fd = open(path, O_RDONLY)) < 0) nanosleep(&second, NULL); /* until pago runs */
  board = mmap(NULL, sizeof *board, PROT_READ, MAP_SHARED, fd, 0);
  if (board == MAP_FAILED) return 1;
  while (__atomic_load_n(&board->magic, __ATOMIC_ACQUIRE) == PAGO_POSE_V1) { /* until pago ends */
    const uint32_t news = __atomic_load_n(&board->news, __ATOMIC_ACQUIRE);
    const int is_new = pago_read_pose_v1(&board->refined, &pose) && pose.sequence != last;
    clock_gettime(CLOCK_REALTIME, &now);
    if (is_new) {
      last = pose.sequence;
      printf("%llu %s at %.3f %.3f %.3f m, health %d, %.2f ms after the sweep's last packet\n",
             (unsigned long long)pose.sequence, pose.child_frame_id, pose.position_m[0], pose.position_m[1],
             pose.position_m[2], pose.health,
             (double)(now.tv_sec * 1000000000LL + now.tv_nsec - pose.last_arrival_ns) * 1e-6);
    } else if (last != UINT64_MAX &&
               now.tv_sec * 1000000000LL + now.tv_nsec - pose.published_ns > 500000000) {
      printf("the last pose is more than 0.5 s old: do not drive on it\n");
    }
    fflush(stdout);
    /* Sleeps until something new was published; a word that has changed already does not let it sleep. */
    syscall(SYS_futex, &board->news, FUTEX_WAIT, news, &second, NULL, 0);
  }
  return 0;
}
