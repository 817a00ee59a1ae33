// Checks of a frame that an engine hands to the module: its view, and the textures of its G-buffer.
#include "FrameChecks.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include "ArgumentChecks.h"

namespace Lantern
{

namespace
{

FRTStatus Refuse(const char* Reason) { return FRTStatus::Error(ERTResult::InvalidArgument, "%s", Reason); }

bool AreFinite(const auto(&Values)[3])
{
	return std::all_of(Values, Values + 3, [](auto Value) { return std::isfinite(Value); });
}

FRTStatus CheckView(const FRTModuleView& View)
{
	// What engines keep in half precision still passes; what was never normalised does not.
	constexpr float LengthTolerance = 0.01f, SineTolerance = 1e-4f;
	const glm::vec3 Forward(View.Forward[0], View.Forward[1], View.Forward[2]);
	const glm::vec3 Up(View.Up[0], View.Up[1], View.Up[2]);
	if (!AreFinite(View.Position)) { return Refuse("FRTModuleView::Position is not finite"); }
	if (!(std::abs(length(Forward) - 1.0f) < LengthTolerance))
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTModuleView::Forward must be of unit length, is of %g", double(length(Forward)));
	}
	if (!AreFinite(View.Up) || !(length(cross(Forward, Up)) > SineTolerance * length(Up)))
	{
		return Refuse("FRTModuleView::Up is zero, not finite, or parallel to Forward");
	}
	if (!(View.FovY > 0.0f && View.FovY < glm::pi<float>()))
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTModuleView::FovY must lie between 0 and pi (radians), is %g", double(View.FovY));
	}
	if (!(View.Near > 0.0f) || !std::isfinite(View.Near))
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleView::Near must be positive, is %g", double(View.Near));
	}
	return FRTStatus::Success();
}

/// A texture of the G-buffer, which goes with depth and has one format.
struct FGBufferTexture
{
	const IRTTexture* Texture;
	ERTAccess Access;
	ERTFormat Format;
	const char* Name;
	const char* FormatName;
	const char* AccessName;
};

FRTStatus CheckTexture(const FGBufferTexture& Item, const FRTTextureDesc& Depth)
{
	const auto Fail = [&](const char* Reason, const char* What) {
		return FRTStatus::Error(ERTResult::InvalidArgument, "the %s texture %s %s", Item.Name, Reason, What);
	};
	if (Item.Texture == nullptr) { return FRTStatus::Success(); }
	const FRTTextureDesc& Desc = Item.Texture->GetDesc();
	if (Desc.Width != Depth.Width || Desc.Height != Depth.Height)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "the %s texture is %u x %u, depth is %u x %u", Item.Name, Desc.Width,
		    Desc.Height, Depth.Width, Depth.Height);
	}
	if (Desc.Format != Item.Format) { return Fail("must be", Item.FormatName); }
	if (!HasAny(Desc.Usage, ERTTextureUsage::Sampled)) { return Fail("needs", "ERTTextureUsage::Sampled"); }
	return Item.Access != ERTAccess::None ? FRTStatus::Success()
	                                      : Fail("would be discarded by None: how it was used must be said by", Item.AccessName);
}

FRTStatus CheckGBuffer(const FRTModuleFrame& Frame)
{
	const FRTTextureDesc& Depth = Frame.Depth->GetDesc();
	if (Depth.Format != ERTFormat::D32_FLOAT && Depth.Format != ERTFormat::R32_FLOAT)
	{
		return Refuse("the depth texture must be D32_FLOAT or R32_FLOAT");
	}
	using enum ERTFormat;
	const FGBufferTexture Textures[] = {{Frame.Depth, Frame.DepthAccess, Depth.Format, "depth", "", "DepthAccess"},
	    {Frame.Normals, Frame.NormalsAccess, RGBA16_SNORM, "normals", "RGBA16_SNORM", "NormalsAccess"},
	    {Frame.Motion, Frame.MotionAccess, RGBA32_FLOAT, "motion", "RGBA32_FLOAT", "MotionAccess"},
	    {Frame.BaseColor, Frame.BaseColorAccess, RGBA8_SRGB, "base colour", "RGBA8_SRGB", "BaseColorAccess"},
	    {Frame.Material, Frame.MaterialAccess, RGBA8_UNORM, "material", "RGBA8_UNORM", "MaterialAccess"}};
	FRTStatus Status;
	for (const FGBufferTexture& Texture : Textures) { Status = Status ? CheckTexture(Texture, Depth) : Status; }
	return Status;
}

} // namespace

FRTStatus CheckFrame(const FRTModuleFrame& Frame)
{
	if (Frame.Commands == nullptr) { return RefuseNull("RenderFrame", "FRTModuleFrame::Commands"); }
	if (Frame.Depth == nullptr) { return RefuseNull("RenderFrame", "FRTModuleFrame::Depth"); }
	if (Frame.Normals == nullptr) { return RefuseNull("RenderFrame", "FRTModuleFrame::Normals"); }
	if (!(Frame.DeltaSeconds > 0.0f) || !std::isfinite(Frame.DeltaSeconds))
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTModuleFrame::DeltaSeconds must be positive, is %g", double(Frame.DeltaSeconds));
	}
	const FRTStatus Status = CheckGBuffer(Frame);
	return Status.IsOk() ? CheckView(Frame.View) : Status;
}

} // namespace Lantern
