// Checks of a frame that an engine hands to the module: its view, and the textures of its G-buffer.
#include "FrameChecks.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <utility>

#include <glm/glm.hpp>

#include "ArgumentChecks.h"

namespace Lantern
{

namespace
{

bool AreFinite(const auto& Values)
{
	return std::all_of(std::begin(Values), std::end(Values), [](auto Value) { return std::isfinite(Value); });
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
	for (const float Jitter : View.Jitter)
	{
		if (!(std::abs(Jitter) <= 64.0f))
		{
			return FRTStatus::Error(
			    ERTResult::InvalidArgument, "FRTModuleView::Jitter must lie between -64 and 64 pixels, is %g", double(Jitter));
		}
	}
	return FRTStatus::Success();
}

/// A texture of the G-buffer, which goes with depth and has one of several formats.
struct FGBufferTexture
{
	const IRTTexture* Texture;
	ERTAccess Access;
	std::initializer_list<ERTFormat> Formats;
	const char* Name;
	const char* FormatNames;
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
	if (std::find(Item.Formats.begin(), Item.Formats.end(), Desc.Format) == Item.Formats.end())
	{
		return Fail("must be", Item.FormatNames);
	}
	if (!HasAny(Desc.Usage, ERTTextureUsage::Sampled)) { return Fail("needs", "ERTTextureUsage::Sampled"); }
	return Item.Access != ERTAccess::None ? FRTStatus::Success()
	                                      : Fail("would be discarded by None: how it was used must be said by", Item.AccessName);
}

FRTStatus CheckDepth(const FRTModuleFrame& Frame)
{
	using enum ERTFormat;
	return CheckTexture({Frame.Depth, Frame.DepthAccess, {D32_FLOAT, R32_FLOAT, D32_FLOAT_S8_UINT, D24_UNORM_S8_UINT, D16_UNORM}, "depth",
	                        "D32_FLOAT, D32_FLOAT_S8_UINT, D24_UNORM_S8_UINT, D16_UNORM or R32_FLOAT", "DepthAccess"},
	    Frame.Depth->GetDesc());
}

FRTStatus CheckNormals(const FRTModuleFrame& Frame, const IRTTexture* Texture, ERTAccess Access, const char* Name, const char* AccessName)
{
	using enum ERTFormat;
	const FRTModuleGBufferLayout& Layout = Frame.Layout;
	const FRTTextureDesc& Depth = Frame.Depth->GetDesc();
	if (Layout.Normals == ERTModuleNormals::Xyz)
	{
		return CheckTexture(
		    {Texture, Access,
		        {RGBA8_UNORM, RGBA8_SNORM, BGRA8_UNORM, RGB10A2_UNORM, R11G11B10_FLOAT, RGBA16_UNORM, RGBA16_SNORM, RGBA16_FLOAT,
		            RGBA32_FLOAT},
		        Name, "of a UNORM, SNORM or float format with three channels or more, since Layout.Normals is Xyz", AccessName},
		    Depth);
	}
	if (Layout.bGeometricInZw)
	{
		return CheckTexture(
		    {Texture, Access, {RGBA16_SNORM, RGBA16_UNORM, RGBA16_FLOAT, RGBA8_UNORM, RGBA8_SNORM, RGBA32_FLOAT}, Name,
		        "RGBA16_SNORM, or another UNORM, SNORM or float format with four channels, since Layout.bGeometricInZw is true",
		        AccessName},
		    Depth);
	}
	return CheckTexture(
	    {Texture, Access,
	        {RG8_UNORM, RG16_UNORM, RG16_SNORM, RG16_FLOAT, RG32_FLOAT, RGBA8_UNORM, RGBA8_SNORM, RGB10A2_UNORM, RGBA16_UNORM, RGBA16_SNORM,
	            RGBA16_FLOAT, RGBA32_FLOAT},
	        Name, "of a UNORM, SNORM or float format with two channels or more, since Layout.Normals is Octahedral", AccessName},
	    Depth);
}

FRTStatus CheckMotion(const FRTModuleFrame& Frame)
{
	using enum ERTFormat;
	const FRTTextureDesc& Depth = Frame.Depth->GetDesc();
	if (Frame.Layout.Motion == ERTModuleMotion::Native)
	{
		return CheckTexture(
		    {Frame.Motion, Frame.MotionAccess, {RGBA32_FLOAT}, "motion", "RGBA32_FLOAT, since Layout.Motion is Native", "MotionAccess"},
		    Depth);
	}
	if (Frame.Layout.bMotionDistance)
	{
		return CheckTexture({Frame.Motion, Frame.MotionAccess, {RGBA16_FLOAT, RGBA32_FLOAT}, "motion",
		                        "RGBA16_FLOAT or RGBA32_FLOAT, since Layout.bMotionDistance is true", "MotionAccess"},
		    Depth);
	}
	return CheckTexture({Frame.Motion, Frame.MotionAccess,
	                        {RG16_FLOAT, RG16_UNORM, RG16_SNORM, RG32_FLOAT, RGBA16_FLOAT, RGBA16_UNORM, RGBA16_SNORM, RGBA32_FLOAT},
	                        "motion", "of a UNORM, SNORM or float format with two channels of 16 bits or more", "MotionAccess"},
	    Depth);
}

FRTStatus CheckMaterialTextures(const FRTModuleFrame& Frame)
{
	using enum ERTFormat;
	const FRTTextureDesc& Depth = Frame.Depth->GetDesc();
	const bool bUnreal = Frame.Layout.Material == ERTModuleMaterialLayout::Unreal;
	const FGBufferTexture Native[] = {
	    {Frame.BaseColor, Frame.BaseColorAccess, {RGBA8_SRGB, BGRA8_SRGB}, "base colour", "RGBA8_SRGB or BGRA8_SRGB", "BaseColorAccess"},
	    {Frame.Material, Frame.MaterialAccess, {RGBA8_UNORM, BGRA8_UNORM}, "material", "RGBA8_UNORM or BGRA8_UNORM", "MaterialAccess"}};
	const FGBufferTexture Unreal[] = {
	    {Frame.BaseColor, Frame.BaseColorAccess, {RGBA8_SRGB, BGRA8_SRGB, RGBA8_UNORM, BGRA8_UNORM, RGBA16_FLOAT}, "base colour",
	        "RGBA8_SRGB, BGRA8_SRGB, RGBA8_UNORM, BGRA8_UNORM or RGBA16_FLOAT", "BaseColorAccess"},
	    {Frame.Material, Frame.MaterialAccess, {RGBA8_UNORM, BGRA8_UNORM, RGBA16_FLOAT}, "material",
	        "RGBA8_UNORM, BGRA8_UNORM or RGBA16_FLOAT", "MaterialAccess"}};
	FRTStatus Status;
	for (const FGBufferTexture& Texture : bUnreal ? Unreal : Native) { Status = Status ? CheckTexture(Texture, Depth) : Status; }
	if (!Status || Frame.BackAlbedo == nullptr) { return Status; }
	if (Frame.BaseColor == nullptr || Frame.Material == nullptr)
	{
		return Refuse("FRTModuleFrame::BackAlbedo needs BaseColor and Material");
	}
	return CheckTexture({Frame.BackAlbedo, Frame.BackAlbedoAccess, {RGBA8_SRGB, BGRA8_SRGB, RGBA8_UNORM, BGRA8_UNORM, RGBA16_FLOAT},
	                        "back albedo", "RGBA8_SRGB, BGRA8_SRGB, RGBA8_UNORM, BGRA8_UNORM or RGBA16_FLOAT", "BackAlbedoAccess"},
	    Depth);
}

FRTStatus CheckLayout(const FRTModuleGBufferLayout& Layout)
{
	const auto IsPast = [](auto Value, auto Last) { return static_cast<uint32_t>(Value) > static_cast<uint32_t>(Last); };
	const char* Wrong = nullptr;
	if (IsPast(Layout.Depth, ERTModuleDepth::Linear)) { Wrong = "Depth"; }
	if (IsPast(Layout.Normals, ERTModuleNormals::Xyz)) { Wrong = "Normals"; }
	if (IsPast(Layout.NormalRange, ERTModuleRange::Unsigned)) { Wrong = "NormalRange"; }
	if (IsPast(Layout.Motion, ERTModuleMotion::UV)) { Wrong = "Motion"; }
	if (IsPast(Layout.Material, ERTModuleMaterialLayout::Unreal)) { Wrong = "Material"; }
	if (Wrong != nullptr)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleGBufferLayout::%s is none of its values", Wrong);
	}
	if (!AreFinite(Layout.MotionScale) || !AreFinite(Layout.MotionOffset))
	{
		return Refuse("FRTModuleGBufferLayout::MotionScale or MotionOffset is not finite");
	}
	return FRTStatus::Success();
}

/// The view's part of the textures.
FRTStatus CheckPart(const FRTModuleFrame& Frame)
{
	constexpr uint32_t Most = 1u << 16;
	const FRTTextureDesc& Whole = Frame.Depth->GetDesc();
	const auto Check = [](uint32_t Offset, uint32_t Size, uint32_t All, const char* OffsetName, const char* SizeName) {
		if (Offset >= All || Offset >= Most)
		{
			return FRTStatus::Error(
			    ERTResult::InvalidArgument, "FRTModuleFrame::%s is %u, the textures have %u pixels", OffsetName, Offset, All);
		}
		return Size <= All - Offset
		           ? FRTStatus::Success()
		           : FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleFrame::%s is %u, the textures have %u pixels from %s on",
		                 SizeName, Size, All - Offset, OffsetName);
	};
	const FRTStatus Status = Check(Frame.OffsetX, Frame.Width, Whole.Width, "OffsetX", "Width");
	return Status ? Check(Frame.OffsetY, Frame.Height, Whole.Height, "OffsetY", "Height") : Status;
}

FRTStatus CheckGBuffer(const FRTModuleFrame& Frame)
{
	FRTStatus Status = CheckLayout(Frame.Layout);
	if (Status) { Status = CheckDepth(Frame); }
	if (Status) { Status = CheckPart(Frame); }
	if (Status) { Status = CheckNormals(Frame, Frame.Normals, Frame.NormalsAccess, "normals", "NormalsAccess"); }
	if (Status)
	{
		Status = CheckNormals(Frame, Frame.GeometricNormals, Frame.GeometricNormalsAccess, "geometric normals", "GeometricNormalsAccess");
	}
	if (Status) { Status = CheckMotion(Frame); }
	if (Status) { Status = CheckMaterialTextures(Frame); }
	if (!Status) { return Status; }
	const FRTTextureDesc& Depth = Frame.Depth->GetDesc();
	Status = CheckTexture({Frame.Classes, Frame.ClassesAccess, {ERTFormat::R8_UNORM}, "classes", "R8_UNORM", "ClassesAccess"}, Depth);
	if (!Status) { return Status; }
	Status = CheckTexture({Frame.Channels, Frame.ChannelsAccess, {ERTFormat::R8_UNORM}, "channels", "R8_UNORM", "ChannelsAccess"}, Depth);
	if (!Status) { return Status; }
	return CheckTexture(
	    {Frame.ToonNumbers, Frame.ToonNumbersAccess, {ERTFormat::R8_UNORM}, "toon numbers", "R8_UNORM", "ToonNumbersAccess"}, Depth);
}

/// What does not say whose it is passes.
FRTStatus CheckOwners(const FRTModuleFrame& Frame, const IRTDevice& Device)
{
	const uint64_t Mine = Device.GetNative(ERTNative::Device);
	const auto Check = [&](const auto* Item, const char* Name) {
		const uint64_t Owner = Item != nullptr ? Item->GetNative(ERTNative::Device) : 0;
		return Owner == 0 || Mine == 0 || Owner == Mine
		           ? FRTStatus::Success()
		           : FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleFrame::%s is of another device than the renderer", Name);
	};
	FRTStatus Status = Check(Frame.Commands, "Commands");
	const std::pair<const IRTTexture*, const char*> Textures[] = {{Frame.Depth, "Depth"}, {Frame.Normals, "Normals"},
	    {Frame.GeometricNormals, "GeometricNormals"}, {Frame.Motion, "Motion"}, {Frame.BaseColor, "BaseColor"},
	    {Frame.Material, "Material"}, {Frame.Classes, "Classes"}, {Frame.Channels, "Channels"}, {Frame.ToonNumbers, "ToonNumbers"},
	    {Frame.BackAlbedo, "BackAlbedo"}};
	for (const auto& [Texture, Name] : Textures) { Status = Status ? Check(Texture, Name) : Status; }
	return Status;
}

} // namespace

FRTStatus CheckPrecache(const FRTModuleFrame& Frame)
{
	if (Frame.Depth == nullptr || Frame.Normals == nullptr) { return CheckLayout(Frame.Layout); }
	const FRTStatus Status = CheckGBuffer(Frame);
	return Status ? CheckView(Frame.View) : Status;
}

FRTStatus CheckFrame(const FRTModuleFrame& Frame, const IRTDevice& Device)
{
	if (Frame.Commands == nullptr) { return RefuseNull("RenderFrame", "FRTModuleFrame::Commands"); }
	if (Frame.Depth == nullptr) { return RefuseNull("RenderFrame", "FRTModuleFrame::Depth"); }
	if (Frame.Normals == nullptr) { return RefuseNull("RenderFrame", "FRTModuleFrame::Normals"); }
	if (!(Frame.DeltaSeconds > 0.0f) || !std::isfinite(Frame.DeltaSeconds))
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTModuleFrame::DeltaSeconds must be positive, is %g", double(Frame.DeltaSeconds));
	}
	if (!(Frame.Exposure >= 0.0f) || !std::isfinite(Frame.Exposure))
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTModuleFrame::Exposure must be finite and not negative, is %g", double(Frame.Exposure));
	}
	if (!(std::abs(Frame.FogPhase) < 1.0f))
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTModuleFrame::FogPhase must lie between -1 and 1, is %g", double(Frame.FogPhase));
	}
	FRTStatus Status = CheckOwners(Frame, Device);
	if (Status) { Status = CheckGBuffer(Frame); }
	if (Status) { Status = CheckView(Frame.View); }
	if (!Status || Frame.PreviousView == nullptr) { return Status; }
	Status = CheckView(*Frame.PreviousView);
	return Status ? Status : FRTStatus::Error(Status.Code, "FRTModuleFrame::PreviousView: %s", Status.Message);
}

} // namespace Lantern
