// How shadows are drawn: with which technique, from maps of which size, and what is left out.
#pragma once

#include <optional>
#include <string>

#include "analysis/law/texel_choice.h"
#include "renderer/cascades.h"
#include "renderer/depth_encoding.h"
#include "renderer/light_frustum.h"
#include "renderer/need_meter.h"
#include "renderer/techniques/technique.h"

namespace stairstep {

/// What frames leave out because nothing of it would be seen. The picture is the same with and without.
struct Skips {
    /// The lighting of surfaces that others hide: where it costs less, surfaces are stored first, then lit.
    bool hidden_surfaces = true;
    /// Storing surfaces where lighting them as they are drawn costs less (surface_choice.h).
    bool needless_storing = true;
    /// Most of what nearer surfaces cover: they are drawn front to back.
    bool overdraw = true;
    /// Back faces of solids.
    bool back_faces = true;
    /// Surfaces outside the view, and casters that can shade nothing visible.
    bool unseen_triangles = true;
    /// Maps of lights whose shadows nothing visible can receive.
    bool unseen_shadows = true;
    /// Maps and filters of lights whose shadows no pixel shows, and lights that no pixel's surface sees.
    bool hidden_shadows = true;
    /// Depth passes where nothing changed, and casters that stand still where only others move.
    bool unchanged_maps = true;
    /// Surfaces and filters where the last frame had the same pixels.
    bool unchanged_pixels = true;
    /// Filters and searches over texels that are all lit, or all dark.
    bool even_texels = true;

    bool operator==(const Skips&) const = default;
};

/// A skip by the name it has on the command line.
struct SkipName {
    std::string_view name;
    bool Skips::*skip;
};

inline constexpr SkipName kSkips[]{
    {"hidden-surfaces", &Skips::hidden_surfaces},
    {"needless-storing", &Skips::needless_storing},
    {"overdraw", &Skips::overdraw},
    {"back-faces", &Skips::back_faces},
    {"unseen-triangles", &Skips::unseen_triangles},
    {"unseen-shadows", &Skips::unseen_shadows},
    {"hidden-shadows", &Skips::hidden_shadows},
    {"unchanged-maps", &Skips::unchanged_maps},
    {"unchanged-pixels", &Skips::unchanged_pixels},
    {"even-texels", &Skips::even_texels},
};

/// "hidden-surfaces, unseen-triangles, …".
std::string skip_names();

/// All skips but those in the list of names, separated by commas; "all" is all of them, and "" none. Throws InputError that lists
/// the names there are.
Skips skips_without(const std::string& names);

/// Draws frames as if something had moved since the last: so pictures that stand still are timed.
inline constexpr const char* kDrawsUnchanged = "unchanged-maps,unchanged-pixels";

struct ShadowSettings {
    TechniqueSettings technique;
    /// Half-width of a constant filter, world units across the light (at the scene's middle, for a spot), > 0.
    double radius = 0;
    /// Side of a fixed, square map; nullopt is the law's.
    std::optional<int> fixed_size;
    /// Of the law's.
    int largest_size = 8192;
    Fit fit = Fit::axis_aligned;
    /// Of a directional light's map.
    Warp warp = Warp::none;
    /// How maps store depth; linear for spots is for hard and pcf, whose comparisons are texel by texel.
    DepthEncoding depth;
    /// For techniques whose radius differs from pixel to pixel.
    NeedStatistic statistic;
    TexelPatience patience;
    Cascades cascades;
    Skips skips;
};

}  // namespace stairstep
