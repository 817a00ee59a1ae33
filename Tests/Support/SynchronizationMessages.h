// What the validation layer says of synchronization, sorted: Docs/Drivers.md explains each kind.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace Lantern
{

/// An access that a layer of before October 2023 supposes: it takes each descriptor of a bindless array for used by each draw, dispatch and
/// trace whose shader names the array. Kinds are rows of the table in Docs/Drivers.md.
enum class ESupposedAccess
{
	None,             ///< the message tells of a real hazard, or of something else
	ReadAfterWrite,   ///< supposed read after a write
	ReadAfterLayout,  ///< supposed read after a change of layout for other accesses
	WriteAfterRead,   ///< supposed write after a supposed or real read
	WriteAfterLayout, ///< supposed write after a change of layout for other accesses
	LayoutAfterRead,  ///< barrier that knows nothing of a supposed read
	LayoutAfterWrite, ///< barrier that knows nothing of a supposed write
};

inline ESupposedAccess FindSupposedAccess(std::string_view Text)
{
	const auto Has = [&](std::string_view Part) { return Text.find(Part) != std::string_view::npos; };
	const bool bAfterLayout = Has("prior_usage: SYNC_IMAGE_LAYOUT_TRANSITION");
	if (Has("[Lantern bindless]"))
	{
		if (Has("Hazard READ_AFTER_WRITE")) { return bAfterLayout ? ESupposedAccess::ReadAfterLayout : ESupposedAccess::ReadAfterWrite; }
		if (Has("Hazard WRITE_AFTER_READ")) { return ESupposedAccess::WriteAfterRead; }
		if (Has("Hazard WRITE_AFTER_WRITE") && bAfterLayout) { return ESupposedAccess::WriteAfterLayout; }
	}
	// A barrier names no descriptor. The command of what came before tells that it was a shader.
	const bool bShader = Has("command: vkCmdDispatch") || Has("command: vkCmdDraw") || Has("command: vkCmdTraceRays");
	if (bShader && Has("vkCmdPipelineBarrier2: Hazard"))
	{
		if (Has("WRITE_AFTER_READ") && Has("_SHADER_SAMPLED_READ, read_barriers")) { return ESupposedAccess::LayoutAfterRead; }
		if (Has("WRITE_AFTER_WRITE") && Has("_SHADER_STORAGE_WRITE, write_barriers")) { return ESupposedAccess::LayoutAfterWrite; }
	}
	return ESupposedAccess::None;
}

/// Sorts messages into kinds of supposed accesses, each once, and all others as they are.
struct FSynchronizationMessages
{
	std::vector<ESupposedAccess> Supposed;
	std::vector<std::string> Others;

	void Add(const std::string& Text)
	{
		const ESupposedAccess Kind = FindSupposedAccess(Text);
		if (Kind == ESupposedAccess::None) { Others.push_back(Text); }
		else if (std::find(Supposed.begin(), Supposed.end(), Kind) == Supposed.end()) { Supposed.push_back(Kind); }
	}
};

} // namespace Lantern
