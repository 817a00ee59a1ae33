// Turns a host's G-buffer into what passes read.
#include "LanternRenderer/HostSurface.h"

#include "HostSurfaceTypes.h"
#include "PassTools.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<float> CVarDepthBias("r.RT.DepthBias", 1.0f,
    "Distance by which rays leave their surfaces for the sake of an imprecise depth buffer, in errors of that depth. Larger values "
    "remove dark dots and detach shadows from their objects. Native depth has no such error.",
    {0, 64});

/// Sine of the angle by which normals of a format may be off.
float GetNormalError(ERTFormat Format)
{
	switch (Format)
	{
	case ERTFormat::RGBA8_UNORM:
	case ERTFormat::BGRA8_UNORM:
	case ERTFormat::RGBA8_SNORM:
	case ERTFormat::RG8_UNORM: return 0.02f;
	case ERTFormat::RGB10A2_UNORM:
	case ERTFormat::R11G11B10_FLOAT: return 0.005f;
	case ERTFormat::RG16_FLOAT:
	case ERTFormat::RGBA16_FLOAT: return 0.001f;
	default: return 0.0f;
	}
}

bool AreNormalsNative(const FHostSurface& Host)
{
	return Host.bOctahedral && !Host.bUnsigned && !Host.bBackAlbedo && Host.bGeometricInZw && Host.NormalAxes == glm::mat3(1.0f);
}

/// The precision that the host's textures leave to rays.
void SetErrors(FFrameContext& Context, const FHostSurface& Host)
{
	const auto GetFormat = [&](FGraphTexture Texture) { return Context.Graph.GetDesc(Texture).Format; };
	Context.View.DepthError = GetDepthError(GetFormat(Host.Depth), Host.DepthMeaning) * CVarDepthBias.GetOnRenderThread();
	Context.View.bDerivedNormals = !Host.bGeometricInZw && !Host.GeometricNormals.IsValid();
	const FGraphTexture Geometric = Host.GeometricNormals.IsValid() ? Host.GeometricNormals : Host.Normals;
	Context.View.NormalError = GetNormalError(GetFormat(Geometric));
}

uint32_t MakeFlags(const FHostSurface& Host)
{
	const FHostDepth& Depth = Host.DepthMeaning;
	uint32_t Flags = 0;
	const auto Add = [&](bool bSet, uint32_t Flag) { Flags |= bSet ? Flag : 0u; };
	Add(Depth.bOrthographic, HOST_DEPTH_ORTHOGRAPHIC);
	Add(Depth.bReversed, HOST_DEPTH_REVERSED);
	Add(Depth.bLinear, HOST_DEPTH_LINEAR);
	Add(Host.bOctahedral, HOST_NORMALS_OCTAHEDRAL);
	Add(Host.bUnsigned, HOST_NORMALS_UNSIGNED);
	Add(Host.bGeometricInZw, HOST_GEOMETRIC_IN_ZW);
	Add(Host.bMotionInUV && !Host.bNativeMotion, HOST_MOTION_IN_UV);
	Add(Host.bMotionDistance || Host.bNativeMotion, HOST_MOTION_DISTANCE);
	Add(Host.bMotionPartial && !Host.bNativeMotion, HOST_MOTION_PARTIAL);
	Add(Host.bUnrealMaterial, HOST_MATERIAL_UNREAL);
	Add(glm::determinant(Host.NormalAxes) < 0.0f, HOST_NORMALS_MIRRORED);
	return Flags;
}

FHostSurfaceConstants MakeConstants(const FHostSurface& Host)
{
	FHostSurfaceConstants C{};
	C.Offset = Host.Offset.x | (Host.Offset.y << 16);
	C.Flags = MakeFlags(Host);
	C.DepthAtZero = static_cast<float>(Host.DepthMeaning.AtZero);
	C.DepthAtOne = static_cast<float>(Host.DepthMeaning.AtOne);
	C.MotionScale = Host.bNativeMotion ? glm::vec2(1) : Host.MotionScale;
	C.MotionOffset = Host.bNativeMotion ? glm::vec2(0) : Host.MotionOffset;
	C.NormalX = Host.NormalAxes[0];
	C.NormalY = Host.NormalAxes[1];
	return C;
}

void AddPass(FFrameContext& Context, const FHostSurface& Host, IRTPipeline* Pipeline, const FGBuffer& Out)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("HostSurface", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture :
		    {Host.Depth, Host.Normals, Host.GeometricNormals, Host.Motion, Host.BaseColor, Host.Material, Host.BackAlbedo})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		for (const FGraphTexture Texture : {Out.Depth, Out.Normals, Out.Motion, Out.BaseColor, Out.Material, Out.BackAlbedo})
		{
			if (Texture.IsValid()) { Builder.WriteIfRead(Texture, ERTAccess::StorageWrite); }
		}
		Frame->Tokens.LeaveAlone(Builder);
		return [=](FPassContext& Pass) {
			FHostSurfaceConstants C = MakeConstants(Host);
			C.Pass = Frame->Pass;
			C.Depth = GetSampledIndex(Pass, Host.Depth);
			C.Normals = GetSampledIndex(Pass, Host.Normals);
			C.GeometricNormals = GetSampledIndex(Pass, Host.GeometricNormals);
			C.Motion = GetSampledIndex(Pass, Host.Motion);
			C.BaseColor = GetSampledIndex(Pass, Host.BaseColor);
			C.Material = GetSampledIndex(Pass, Host.Material);
			C.BackAlbedo = GetSampledIndex(Pass, Host.BackAlbedo);
			C.OutDepth = GetStorageIndex(Pass, Out.Depth);
			C.OutNormals = GetStorageIndex(Pass, Out.Normals);
			C.OutMotion = GetStorageIndex(Pass, Out.Motion);
			C.OutBaseColor = GetStorageIndex(Pass, Out.BaseColor);
			C.OutMaterial = GetStorageIndex(Pass, Out.Material);
			C.OutBackAlbedo = GetStorageIndex(Pass, Out.BackAlbedo);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, HOST_SURFACE_GROUP_SIZE);
		};
	});
}
} // namespace

bool NeedsHostSurfacePass(const FHostSurface& Host)
{
	return !Host.DepthMeaning.IsNative() || !AreNormalsNative(Host) || !Host.bNativeMotion || Host.bUnrealMaterial ||
	       Host.Offset != glm::uvec2(0);
}

FShaderSource MakeHostSurfaceSource() { return MakeComputeSource("HostSurface/HostSurface.comp"); }

FGBuffer AddHostSurfacePass(FFrameContext& Context, const FHostSurface& Host)
{
	SetErrors(Context, Host);
	const bool bMoved = Host.Offset != glm::uvec2(0);
	FGBuffer Converted, Out;
	const auto Choose = [&](FGraphTexture From, bool bNative, ERTFormat Format, const char* Name, FGraphTexture& OutMade) {
		if (!From.IsValid() || (bNative && !bMoved)) { return From; }
		return OutMade = Context.Graph.CreateTexture({Context.Width, Context.Height, Format}, Name);
	};
	Out.Depth = Choose(Host.Depth, Host.DepthMeaning.IsNative(), ERTFormat::R32_FLOAT, "HostDepth", Converted.Depth);
	Out.Normals = Choose(Host.Normals, AreNormalsNative(Host), ERTFormat::RGBA16_SNORM, "HostNormals", Converted.Normals);
	Out.Motion = Choose(Host.Motion, Host.bNativeMotion, ERTFormat::RGBA32_FLOAT, "HostMotion", Converted.Motion);
	const bool bMaterial = Host.BaseColor.IsValid() && Host.Material.IsValid();
	if (bMaterial)
	{
		if (Context.Facts.bBackPixels)
		{
			Out.BackAlbedo = Choose(Host.BackAlbedo, true, ERTFormat::RGBA16_FLOAT, "HostBackAlbedo", Converted.BackAlbedo);
		}
		Out.BaseColor = Choose(Host.BaseColor, !Host.bUnrealMaterial, ERTFormat::RGBA16_FLOAT, "HostBaseColor", Converted.BaseColor);
		Out.Material = Choose(Host.Material, !Host.bUnrealMaterial, ERTFormat::RGBA8_UNORM, "HostMaterial", Converted.Material);
	}
	const bool bAny = Converted.Depth.IsValid() || Converted.Normals.IsValid() || Converted.Motion.IsValid() ||
	                  Converted.BaseColor.IsValid() || Converted.BackAlbedo.IsValid();
	IRTPipeline* const Pipeline = bAny ? RequireCompute(Context, MakeHostSurfaceSource()) : nullptr;
	if (bAny && Pipeline == nullptr) { return {}; }
	if (bAny) { AddPass(Context, Host, Pipeline, Converted); }
	return Out;
}

} // namespace Lantern
