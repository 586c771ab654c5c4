// Sizes so small that no mesh could be made are refused before anything long runs.
#pragma once

#include <lamina/pipeline.hpp>

namespace lamina {

/// Throws UsageError, with the option's name and about how many triangles it asks for by itself, where these are more
/// than can be numbered. `domain` is the far field's box.
void require_feasible_sizes(const Pslg& pslg, const CaseOptions& options, const Box& domain);

/// The same for what all sizes together ask for.
void require_feasible(const SizeField& size, const CaseOptions& options);

}  // namespace lamina
