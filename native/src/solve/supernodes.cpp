// Elimination tree (Liu 1990), column counts from the skeleton (Gilbert, Ng, Peyton 1994), and columns joined with their parents
// where that adds few zeros (Ashcraft and Grimes 1989).
#include "solve/supernodes.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solve/front_tasks.h"
#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

/// A forest over columns, every parent after its children.
struct Tree {
  std::vector<int> parent;
  std::vector<int> first_child, next_sibling;  // -1 at the ends
};

Tree tree_of(std::vector<int> parent) {
  const int n = static_cast<int>(parent.size());
  Tree tree{std::move(parent), std::vector<int>(n, -1), std::vector<int>(n, -1)};
  for (int k = n - 1; k >= 0; --k) {
    if (tree.parent[k] < 0) continue;
    tree.next_sibling[k] = tree.first_child[tree.parent[k]];
    tree.first_child[tree.parent[k]] = k;
  }
  return tree;
}

std::vector<int> inverse(const std::vector<int>& order) {
  std::vector<int> position(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) position[order[k]] = static_cast<int>(k);
  return position;
}

std::vector<int> elimination_tree(const Adjacency& graph) {
  const int n = graph.size();
  std::vector<int> parent(n, -1), ancestor(n, -1);
  for (int k = 0; k < n; ++k) {
    for (int e = graph.start[k]; e < graph.start[k + 1]; ++e) {
      for (int i = graph.nodes[e]; i >= 0 && i < k;) {
        const int next = ancestor[i];
        ancestor[i] = k;
        if (next < 0) parent[i] = k;
        i = next;
      }
    }
  }
  return parent;
}

/// Columns such that every subtree is consecutive.
std::vector<int> postorder(const Tree& tree) {
  const int n = static_cast<int>(tree.parent.size());
  std::vector<int> out, pending = tree.first_child;
  out.reserve(n);
  for (int root = 0; root < n; ++root) {
    if (tree.parent[root] >= 0) continue;
    for (int k = root; k >= 0;) {
      if (const int child = pending[k]; child >= 0) {
        pending[k] = tree.next_sibling[child];
        k = child;
      } else {
        out.push_back(k);
        k = k == root ? -1 : tree.parent[k];
      }
    }
  }
  return out;
}

/// Entries below the diagonal of each column of the factor; the order must be a postorder.
std::vector<int> column_counts(const Adjacency& graph, const std::vector<int>& order, const std::vector<int>& position,
                               const Tree& tree) {
  const int n = graph.size();
  std::vector<int> counts(n), first_descendant(n), largest_first(n, -1), previous_leaf(n, -1), ancestor(n);
  std::iota(ancestor.begin(), ancestor.end(), 0);
  std::iota(first_descendant.begin(), first_descendant.end(), 0);
  for (int k = 0; k < n; ++k) {
    counts[k] = tree.first_child[k] < 0 ? 1 : 0;
    if (const int p = tree.parent[k]; p >= 0) first_descendant[p] = std::min(first_descendant[p], first_descendant[k]);
  }
  const auto root_of = [&](int k) {
    while (ancestor[k] != k) k = ancestor[k] = ancestor[ancestor[k]];
    return k;
  };
  for (int k = 0; k < n; ++k) {
    if (tree.parent[k] >= 0) --counts[tree.parent[k]];
    for (int e = graph.start[order[k]]; e < graph.start[order[k] + 1]; ++e) {
      const int row = position[graph.nodes[e]];
      if (row <= k || first_descendant[k] <= largest_first[row]) continue;  // not a leaf of the row's subtree
      largest_first[row] = first_descendant[k];
      ++counts[k];
      if (previous_leaf[row] >= 0) --counts[root_of(previous_leaf[row])];
      previous_leaf[row] = k;
    }
    if (tree.parent[k] >= 0) ancestor[k] = tree.parent[k];
  }
  for (int k = 0; k < n; ++k) {
    if (tree.parent[k] >= 0) counts[tree.parent[k]] += counts[k];
  }
  for (int& count : counts) --count;
  return counts;
}

/// Columns under one top column.
struct Group {
  int columns = 1;
  double entries = 0;  ///< of the factor that are not zero
};

double stored_entries(double columns, double below) { return columns * (0.5 * (columns + 1) + below); }

/// True where so many columns may hold such a share of zeros: the fewer they are, the more a front of their own would cost.
bool worth_joining(int columns, double zeros) {
  return zeros <= 0.1 || columns <= 4 || (columns <= 16 && zeros < 0.4) || (columns <= 64 && zeros < 0.2);
}

/// Of each column the top one of its group.
std::vector<int> join_columns(const Tree& tree, const std::vector<int>& counts) {
  const int n = static_cast<int>(counts.size());
  std::vector<int> top(n);
  std::iota(top.begin(), top.end(), 0);
  std::vector<Group> groups(n);
  std::vector<std::pair<double, int>> children;
  for (int k = 0; k < n; ++k) {
    Group& group = groups[k];
    group.entries = stored_entries(1, counts[k]);
    children.clear();
    for (int c = tree.first_child[k]; c >= 0; c = tree.next_sibling[c]) {
      const Group& child = groups[c];
      children.emplace_back(stored_entries(child.columns + 1, counts[k]) - child.entries, c);
    }
    std::sort(children.begin(), children.end());
    for (const auto& [cost, c] : children) {
      const int columns = group.columns + groups[c].columns;
      const double entries = group.entries + groups[c].entries, stored = stored_entries(columns, counts[k]);
      if (!worth_joining(columns, (stored - entries) / stored)) continue;
      group = {columns, entries};
      top[c] = k;
    }
  }
  for (int k = n - 1; k >= 0; --k) top[k] = top[top[k]];
  return top;
}

/// Groups in postorder become supernodes, their columns in ascending order. Below a group lies what is below its top column.
void number_groups(const Tree& tree, const std::vector<int>& top, const std::vector<int>& counts, const std::vector<int>& order,
                   Supernodes& out) {
  const int n = static_cast<int>(top.size());
  std::vector<int> group_of(n, -1), parent;  // by top column
  int count = 0;
  for (int k = 0; k < n; ++k) {
    if (top[k] == k) group_of[k] = count++;
  }
  std::vector<int> below;
  for (int k = 0; k < n; ++k) {
    if (top[k] != k) continue;
    parent.push_back(tree.parent[k] < 0 ? -1 : group_of[top[tree.parent[k]]]);
    below.push_back(counts[k]);
  }
  const std::vector<int> sequence = postorder(tree_of(parent)), rank = inverse(sequence);
  out.parent.resize(count);
  out.row_start.assign(1, 0);
  for (int s = 0; s < count; ++s) {
    out.parent[s] = parent[sequence[s]] < 0 ? -1 : rank[parent[sequence[s]]];
    out.row_start.push_back(out.row_start.back() + below[sequence[s]]);
  }
  out.first.assign(count + 1, 0);
  for (int k = 0; k < n; ++k) ++out.first[rank[group_of[top[k]]] + 1];
  for (int s = 0; s < count; ++s) out.first[s + 1] += out.first[s];
  std::vector<int> next(out.first.begin(), out.first.end() - 1);
  out.order.resize(n);
  for (int k = 0; k < n; ++k) out.order[next[rank[group_of[top[k]]]]++] = order[k];
  out.position = inverse(out.order);
}

void list_children(Supernodes& out) {
  out.child_start.assign(out.count() + 1, 0);
  for (const int p : out.parent) {
    if (p >= 0) ++out.child_start[p + 1];
  }
  for (int s = 0; s < out.count(); ++s) out.child_start[s + 1] += out.child_start[s];
  out.children.resize(out.child_start.back());
  std::vector<int> next(out.child_start.begin(), out.child_start.end() - 1);
  for (int s = 0; s < out.count(); ++s) {
    if (out.parent[s] >= 0) out.children[next[out.parent[s]]++] = s;
  }
}

/// Rows of a supernode: those of its columns and of its children. `seen`: by position, what it was last seen for.
void find_rows(const Adjacency& graph, int s, std::vector<int>& seen, Supernodes& out) {
  const auto begin = out.rows.begin() + out.row_start[s];
  auto end = begin;
  const auto add = [&](int row) {
    if (row < out.first[s + 1] || seen[row] == s) return;
    seen[row] = s;
    *end++ = row;
  };
  for (int k = out.first[s]; k < out.first[s + 1]; ++k) {
    for (int e = graph.start[out.order[k]]; e < graph.start[out.order[k] + 1]; ++e) add(out.position[graph.nodes[e]]);
  }
  for (int c = out.child_start[s]; c < out.child_start[s + 1]; ++c) {
    const int child = out.children[c];
    for (int e = out.row_start[child]; e < out.row_start[child + 1]; ++e) add(out.rows[e]);
  }
  std::sort(begin, end);
}

/// Where the rows of a child of supernode p lie in p's front.
void find_rows_in_parent(int child, int p, Supernodes& out) {
  int at = out.row_start[p];
  for (int e = out.row_start[child]; e < out.row_start[child + 1]; ++e) {
    if (out.rows[e] < out.first[p + 1]) {
      out.row_in_parent[e] = out.rows[e] - out.first[p];
      continue;
    }
    while (out.rows[at] != out.rows[e]) ++at;
    out.row_in_parent[e] = out.pivots(p) + at - out.row_start[p];
  }
}

/// Subtrees side by side.
void find_all_rows(const Adjacency& graph, Supernodes& out) {
  out.rows.resize(out.row_start.back());
  out.row_in_parent.resize(out.rows.size());
  const int threads = present_threads();
  const std::vector<FrontTask> tasks = divide_fronts(out, threads);
  std::vector<std::vector<int>> seen(threads);
  run_tasks_up(tasks, tasks.size() > 1 ? threads : 1, [&](int task, int worker) {
    if (seen[worker].empty()) seen[worker].assign(graph.size(), -1);
    for (int s = tasks[task].begin; s < tasks[task].end; ++s) {
      find_rows(graph, s, seen[worker], out);
      for (int c = out.child_start[s]; c < out.child_start[s + 1]; ++c) find_rows_in_parent(out.children[c], s, out);
    }
    return true;
  });
}

}  // namespace

double Supernodes::work(int s) const {
  const double w = pivots(s), r = below(s);
  return w * (w * w / 3 + w * r + r * r);
}

Supernodes find_supernodes(const Adjacency& graph) {
  // The elimination tree of a postorder is the same tree with other numbers.
  const std::vector<int> parent = elimination_tree(graph);
  const std::vector<int> sequence = postorder(tree_of(parent)), rank = inverse(sequence);
  std::vector<int> renumbered(parent.size());
  for (std::size_t k = 0; k < parent.size(); ++k) renumbered[k] = parent[sequence[k]] < 0 ? -1 : rank[parent[sequence[k]]];
  const Tree tree = tree_of(std::move(renumbered));
  const std::vector<int> counts = column_counts(graph, sequence, rank, tree);
  Supernodes out;
  number_groups(tree, join_columns(tree, counts), counts, sequence, out);
  list_children(out);
  find_all_rows(graph, out);
  return out;
}

}  // namespace atlas_refine
