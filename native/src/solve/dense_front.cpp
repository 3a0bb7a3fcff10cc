// Panels in chunks of columns, rows in tiles of eight. Sections of the code that depend on the registers are templates over their
// width, instantiated once for each instruction set.
#include "solve/dense_front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "support/inline.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

constexpr int kTile = 8;     // rows of a tile, most columns of a block
constexpr int kChunk = 128;  // most columns that are packed at a time

template <int Lanes>
struct Register {
  typedef double Type __attribute__((vector_size(8 * Lanes)));
};

template <class Type>
ATLAS_REFINE_INLINE void load(Type& value, const double* from) {
  __builtin_memcpy(&value, from, sizeof(Type));
}
template <class Type>
ATLAS_REFINE_INLINE void store(const Type& value, double* to) {
  __builtin_memcpy(to, &value, sizeof(Type));
}

/// sums[c] -= sum over k < depth of rows[k][.] * columns[k][c]; both are packed, a tile's width a step.
template <int Lanes, int Columns>
ATLAS_REFINE_INLINE void subtract_products(typename Register<Lanes>::Type (&sums)[Columns], const double* rows,
                                           const double* columns, int depth) {
  for (int k = 0; k < depth; ++k, rows += kTile, columns += kTile) {
    typename Register<Lanes>::Type row;
    load(row, rows);
#pragma GCC unroll 8
    for (int c = 0; c < Columns; ++c) sums[c] -= row * columns[c];
  }
}

/// Columns that a packed tile has room for. One more than are used: the same columns of many tiles would share a set of the
/// cache.
int packed_columns(const Front& front) { return std::min(front.pivots, kChunk) + 1; }

/// Where a tile's products go: `to` by columns `stride` apart.
struct Target {
  double* to;
  int stride;
  int height;  ///< rows that count, even
};

/// target -= rows * columns^T, or -rows * columns^T where it is `Fresh`.
template <int Lanes, int Columns, bool Fresh>
ATLAS_REFINE_INLINE void product_tile(const double* rows, const double* columns, int depth, const Target& target, int from = 0) {
  int row = from;
  for (; row + Lanes <= target.height; row += Lanes) {
    typename Register<Lanes>::Type sums[Columns] = {};
    if constexpr (!Fresh) {
#pragma GCC unroll 8
      for (int c = 0; c < Columns; ++c) load(sums[c], target.to + row + static_cast<std::ptrdiff_t>(c) * target.stride);
    }
    subtract_products<Lanes, Columns>(sums, rows + row, columns, depth);
#pragma GCC unroll 8
    for (int c = 0; c < Columns; ++c) store(sums[c], target.to + row + static_cast<std::ptrdiff_t>(c) * target.stride);
  }
  if constexpr (Lanes > 2) product_tile<Lanes / 2, Columns, Fresh>(rows, columns, depth, target, row);
}

/// A block of columns whose diagonal part is factored: `diagonal` by columns `stride` apart, and its packed rows.
struct Block {
  const double* diagonal;
  const double* packed;
  int depth;  ///< columns of the chunk before it
};

/// Finishes the rows of a tile in a block of columns: products with the columns before, then the triangle. Also packs them.
template <int Lanes, int Columns>
ATLAS_REFINE_INLINE void solve_tile(double* packed, const Block& block, const Target& target, int from = 0) {
  int row = from;
  for (; row + Lanes <= target.height; row += Lanes) {
    typename Register<Lanes>::Type sums[Columns];
#pragma GCC unroll 8
    for (int c = 0; c < Columns; ++c) load(sums[c], target.to + row + static_cast<std::ptrdiff_t>(c) * target.stride);
    subtract_products<Lanes, Columns>(sums, packed + row, block.packed, block.depth);
#pragma GCC unroll 8
    for (int c = 0; c < Columns; ++c) {
      const double* column = block.diagonal + static_cast<std::ptrdiff_t>(c) * target.stride;
      sums[c] *= column[c];
#pragma GCC unroll 8
      for (int d = c + 1; d < Columns; ++d) sums[d] -= sums[c] * column[d];
      store(sums[c], target.to + row + static_cast<std::ptrdiff_t>(c) * target.stride);
      store(sums[c], packed + row + (block.depth + c) * kTile);
    }
  }
  if constexpr (Lanes > 2) solve_tile<Lanes / 2, Columns>(packed, block, target, row);
}

/// Cholesky factor of a small block, the inverse on its diagonal.
ATLAS_REFINE_INLINE bool factor_block(double* block, int stride, int size) {
  for (int k = 0; k < size; ++k) {
    double* column = block + static_cast<std::ptrdiff_t>(k) * stride;
    const double pivot = column[k];
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    column[k] = 1 / std::sqrt(pivot);
    for (int i = k + 1; i < size; ++i) column[i] *= column[k];
    for (int j = k + 1; j < size; ++j) {
      double* other = block + static_cast<std::ptrdiff_t>(j) * stride;
      for (int i = j; i < size; ++i) other[i] -= column[j] * column[i];
    }
  }
  return true;
}

/// Calls body with the number of columns as a constant: even, up to a tile.
template <class Body>
ATLAS_REFINE_INLINE void with_columns(int columns, Body&& body) {
  switch (columns) {
    case 2:
      return body(std::integral_constant<int, 2>());
    case 4:
      return body(std::integral_constant<int, 4>());
    case 6:
      return body(std::integral_constant<int, 6>());
    default:
      return body(std::integral_constant<int, 8>());
  }
}

/// The chunk of columns [begin, end), whose first block has `first` columns, with room for its rows, packed tile by tile from the
/// row after the first block on.
struct Chunk {
  int begin, end, first;
  int room;  ///< columns that a tile has room for
  double* packed;

  int packed_row() const { return begin + first; }
  double* tile(int row) const { return packed + static_cast<std::ptrdiff_t>(row - packed_row()) * room; }
  int depth() const { return end - begin; }
};

template <int Lanes>
ATLAS_REFINE_INLINE bool factor_chunk(const Front& front, const Chunk& chunk) {
  const int stride = front.rows;
  int columns = chunk.first;
  for (int begin = chunk.begin; begin < chunk.end; begin += columns, columns = kTile) {
    double* diagonal = front.panel + begin + static_cast<std::ptrdiff_t>(begin) * stride;
    const Block block{diagonal, begin > chunk.begin ? chunk.tile(begin) : nullptr, begin - chunk.begin};
    if (block.depth > 0) product_tile<Lanes, kTile, false>(block.packed, block.packed, block.depth, {diagonal, stride, kTile});
    if (!factor_block(diagonal, stride, columns)) return false;
    with_columns(
        columns, [&](auto constant) __attribute__((always_inline)) {
          for (int row = begin + columns; row < front.rows; row += kTile) {
            const Target target{front.panel + row + static_cast<std::ptrdiff_t>(begin) * stride, stride,
                                std::min(kTile, front.rows - row)};
            solve_tile<Lanes, constant.value>(chunk.tile(row), block, target);
          }
        });
  }
  return true;
}

/// Tiles of columns after the chunk: those of the panel, then those of the update.
int tiles_after(const Front& front, const Chunk& chunk) { return (front.rows - chunk.end + kTile - 1) / kTile; }

/// Subtracts the chunk's products from a tile of columns of the panel.
template <int Lanes>
ATLAS_REFINE_INLINE void update_panel(const Front& front, const Chunk& chunk, int column) {
  for (int row = column; row < front.rows; row += kTile) {
    const Target target{front.panel + row + static_cast<std::ptrdiff_t>(column) * front.rows, front.rows,
                        std::min(kTile, front.rows - row)};
    product_tile<Lanes, kTile, false>(chunk.tile(row), chunk.tile(column), chunk.depth(), target);
  }
}

template <int Lanes, bool Fresh>
ATLAS_REFINE_INLINE void update_below(const Front& front, const Chunk& chunk, double* update, int column) {
  const int stride = front.below();
  with_columns(
      std::min(kTile, front.rows - column), [&](auto constant) __attribute__((always_inline)) {
        double* to = update + static_cast<std::ptrdiff_t>(column - front.pivots) * stride;
        for (int row = column; row < front.rows; row += kTile) {
          const Target target{to + row - front.pivots, stride, std::min(kTile, front.rows - row)};
          product_tile<Lanes, constant.value, Fresh>(chunk.tile(row), chunk.tile(column), chunk.depth(), target);
        }
      });
}

/// What a chunk does to tiles [begin, end) of the columns after it.
using UpdateTiles = void (*)(const Front& front, const Chunk& chunk, double* update, int begin, int end);

template <int Lanes>
ATLAS_REFINE_INLINE void update_with(const Front& front, const Chunk& chunk, double* update, int begin, int end) {
  for (int tile = begin; tile < end; ++tile) {
    const int column = chunk.end + tile * kTile;
    if (column < front.pivots)
      update_panel<Lanes>(front, chunk, column);
    else if (chunk.begin == 0)
      update_below<Lanes, true>(front, chunk, update, column);
    else
      update_below<Lanes, false>(front, chunk, update, column);
  }
}

/// Tiles are sums of their own: they may be on several threads.
void update_side_by_side(const Front& front, const Chunk& chunk, double* update, int threads, UpdateTiles update_tiles) {
  constexpr double kLeastWork = 4e6;  // multiplications of a part
  const int tiles = tiles_after(front, chunk);
  const double of_tile = static_cast<double>(kTile) * front.rows * chunk.depth();
  if (threads <= 1 || of_tile * tiles < 2 * kLeastWork) return update_tiles(front, chunk, update, 0, tiles);
  parallel_ranges(tiles, threads, static_cast<int>(kLeastWork / of_tile) + 1,
                  [&](int begin, int end) { update_tiles(front, chunk, update, begin, end); });
}

template <int Lanes>
ATLAS_REFINE_INLINE bool factor_with(const Front& front, const FrontOutput& out, UpdateTiles update_tiles) {
  // The first block takes what is over, so that tiles of rows end where the pivots do.
  int first = front.pivots % kTile == 0 ? kTile : front.pivots % kTile;
  for (int begin = 0; begin < front.pivots; first = kTile) {
    const Chunk chunk{begin, std::min(front.pivots, begin + first + kChunk - kTile), first, packed_columns(front), out.packed};
    if (!factor_chunk<Lanes>(front, chunk)) return false;
    update_side_by_side(front, chunk, out.update, out.threads, update_tiles);
    begin = chunk.end;
  }
  return true;
}

/// to[.] -= the columns * factors, summed in the order of the columns.
template <int Lanes, int Columns>
ATLAS_REFINE_INLINE void subtract_columns(const double* columns, int stride, int height, const double* factors, double* to,
                                          int from = 0) {
  int row = from;
  for (; row + Lanes <= height; row += Lanes) {
    typename Register<Lanes>::Type sum, column;
    load(sum, to + row);
#pragma GCC unroll 4
    for (int c = 0; c < Columns; ++c) {
      load(column, columns + row + static_cast<std::ptrdiff_t>(c) * stride);
      sum -= column * factors[c];
    }
    store(sum, to + row);
  }
  if constexpr (Lanes > 2) subtract_columns<Lanes / 2, Columns>(columns, stride, height, factors, to, row);
}

/// Dot products of columns with each of the values: four sums each, whatever the registers.
template <int Columns, int Sides>
ATLAS_REFINE_INLINE void dot_columns(const double* columns, int stride, int height,
                                     const std::array<const double*, Sides>& values, double (&dots)[Sides][Columns]) {
  constexpr int kSums = 4;
  Register<kSums>::Type sums[Sides][Columns] = {};
  int row = 0;
  for (; row + kSums <= height; row += kSums) {
    Register<kSums>::Type value[Sides], column;
#pragma GCC unroll 2
    for (int k = 0; k < Sides; ++k) load(value[k], values[k] + row);
#pragma GCC unroll 4
    for (int c = 0; c < Columns; ++c) {
      load(column, columns + row + static_cast<std::ptrdiff_t>(c) * stride);
#pragma GCC unroll 2
      for (int k = 0; k < Sides; ++k) sums[k][c] += column * value[k];
    }
  }
  for (int k = 0; k < Sides; ++k) {
    for (int c = 0; c < Columns; ++c) {
      double rest = 0;
      for (int i = row; i < height; ++i) rest += columns[i + static_cast<std::ptrdiff_t>(c) * stride] * values[k][i];
      const auto& sum = sums[k][c];
      dots[k][c] = (sum[0] + sum[1]) + (sum[2] + sum[3]) + rest;
    }
  }
}

/// Columns [begin, begin + Columns) of L^-1 on one side.
template <int Lanes, int Columns>
ATLAS_REFINE_INLINE void forward_columns(const Front& front, int begin, const FrontSide& side) {
  const double* columns = front.panel + static_cast<std::ptrdiff_t>(begin) * front.rows;
  double* x = side.at_pivots + begin;
  for (int c = 0; c < Columns; ++c) {
    const double* column = columns + begin + static_cast<std::ptrdiff_t>(c) * front.rows;
    x[c] *= column[c];
    for (int d = c + 1; d < Columns; ++d) x[d] -= column[d] * x[c];
  }
  const int end = begin + Columns;
  subtract_columns<Lanes, Columns>(columns + end, front.rows, front.pivots - end, x, x + Columns);
  subtract_columns<Lanes, Columns>(columns + front.pivots, front.rows, front.below(), x, side.below);
}

template <int Columns, int Sides>
ATLAS_REFINE_INLINE void backward_columns(const Front& front, int begin, const FrontSide* sides) {
  const double* columns = front.panel + static_cast<std::ptrdiff_t>(begin) * front.rows;
  const int end = begin + Columns;
  std::array<const double*, Sides> after, below;
  for (int k = 0; k < Sides; ++k) {
    after[k] = sides[k].at_pivots + end;
    below[k] = sides[k].below;
  }
  double inner[Sides][Columns], outer[Sides][Columns];
  dot_columns<Columns, Sides>(columns + end, front.rows, front.pivots - end, after, inner);
  dot_columns<Columns, Sides>(columns + front.pivots, front.rows, front.below(), below, outer);
  for (int k = 0; k < Sides; ++k) {
    double* x = sides[k].at_pivots + begin;
    for (int c = Columns - 1; c >= 0; --c) {
      const double* column = columns + begin + static_cast<std::ptrdiff_t>(c) * front.rows;
      double sum = x[c] - inner[k][c] - outer[k][c];
      for (int d = c + 1; d < Columns; ++d) sum -= column[d] * x[d];
      x[c] = sum * column[c];
    }
  }
}

template <int Lanes>
ATLAS_REFINE_INLINE void forward_with(const Front& front, std::span<const FrontSide> sides) {
  int begin = 0;
  for (; begin + 4 <= front.pivots; begin += 4) {
    for (const FrontSide& side : sides) forward_columns<Lanes, 4>(front, begin, side);
  }
  if (begin == front.pivots) return;
  for (const FrontSide& side : sides) forward_columns<Lanes, 2>(front, begin, side);
}

template <int Sides>
ATLAS_REFINE_INLINE void backward_with(const Front& front, const FrontSide* sides) {
  int begin = front.pivots / 4 * 4;
  if (begin < front.pivots) backward_columns<2, Sides>(front, begin, sides);
  for (begin -= 4; begin >= 0; begin -= 4) backward_columns<4, Sides>(front, begin, sides);
}

// The same code for one set of instructions.
#define ATLAS_REFINE_KERNELS(name, lanes, target)                                                                         \
  target void update_##name(const Front& front, const Chunk& chunk, double* update, int begin, int end) {                 \
    update_with<lanes>(front, chunk, update, begin, end);                                                                 \
  }                                                                                                                       \
  target bool factor_##name(const Front& front, const FrontOutput& out) {                                                 \
    return factor_with<lanes>(front, out, update_##name);                                                                 \
  }                                                                                                                       \
  target void forward_##name(const Front& front, std::span<const FrontSide> sides) { forward_with<lanes>(front, sides); } \
  target void backward_##name(const Front& front, std::span<const FrontSide> sides) {                                     \
    if (sides.size() == 1) return backward_with<1>(front, sides.data());                                                  \
    backward_with<2>(front, sides.data());                                                                                \
  }                                                                                                                       \
  constexpr FrontKernels k_##name{#name, factor_##name, forward_##name, backward_##name};

ATLAS_REFINE_KERNELS(baseline, 2, )
#ifdef __x86_64__
ATLAS_REFINE_KERNELS(avx2, 4, __attribute__((target("avx2"))))
ATLAS_REFINE_KERNELS(avx512, 8, __attribute__((target("avx512f"))))
#endif

}  // namespace

std::vector<FrontKernels> supported_kernels() {
  std::vector<FrontKernels> out = {k_baseline};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) out.push_back(k_avx2);
  if (__builtin_cpu_supports("avx512f")) out.push_back(k_avx512);
#endif
  return out;
}

const FrontKernels& best_kernels() {
  static const FrontKernels best = supported_kernels().back();
  return best;
}

std::size_t packed_size(const Front& front) {
  return (static_cast<std::size_t>(front.rows) + 2 * kTile) / kTile * kTile * packed_columns(front);
}

}  // namespace atlas_refine
