# Peer of benches/mds.rs in R: the same items from the same start, by monoMDS of vegan (Kruskal's method, in Fortran).
#
# Usage: Rscript --vanilla mds.R INPUTS        prints one JSON line per measurement
# Inputs as for mds.py.
suppressMessages(library(vegan))

folder <- commandArgs(TRUE)[1]
floats <- function(name, n) readBin(file.path(folder, name), "numeric", n, size = 4, endian = "little")

# Stress-1 of a configuration, computed the same way for every peer.
stress <- function(dissimilarities, points) {
  distances <- as.vector(dist(points))[order(dissimilarities)]
  sqrt(sum((distances - isoreg(distances)$yf)^2) / sum(distances^2))
}

for (n in c(25, 100, 500)) {
  d <- floats(sprintf("nmds_%d.f32", n), n * (n - 1) / 2)
  start <- matrix(floats(sprintf("nmds_init_%d.f32", n), 2 * n), n, 2, byrow = TRUE)
  # `dist` stores the lower triangle by columns, which equals the upper triangle by rows.
  items <- structure(d, Size = n, class = "dist", Diag = FALSE, Upper = FALSE)
  fit <- function() monoMDS(items, y = start, k = 2, model = "global", maxit = 1000, sfgrmin = 1e-7, sratmax = 0.999999)
  found <- fit()
  inner <- max(1, ceiling(0.3 / max(system.time(fit())[3], 1e-3)))
  reps <- Sys.getenv("BENCH_REPS", "5")
  for (i in seq_len(as.integer(reps))) {
    t <- system.time(for (j in seq_len(inner)) fit()) / inner
    cat(sprintf(paste0(
      '{"case": "nonmetric MDS of %d items, one start", "peer": "R vegan monoMDS", "cpu_s": %.6g, "wall_s": %.6g, ',
      '"units": 1, "unit": "fit", "per_s": %.6g, "threads": 1, "note": "stress %.7f"}\n'),
      n, t[1] + t[2], t[3], 1 / (t[1] + t[2]), stress(d, found$points)))
  }
}
