// Draws triangles as an engine would, in its own conventions.
#include "EngineRaster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>

#include <glm/gtc/packing.hpp>
#include <vulkan/vulkan_core.h>

namespace Lantern
{

namespace
{
/// Shared with the shaders below.
struct FFrameData
{
	glm::mat4 RelativeToClip;                   ///< to the textures, with jitter
	glm::mat4 ViewToPicture, PreviousToPicture; ///< to the view's clip space, from positions relative to each camera, without jitter
	glm::vec4 Motion;                           ///< what is stored: xy · Motion.xy + Motion.zw, in pixels
	uint64_t Positions, Normals;
	glm::vec3 Eye, Right, Up, PreviousEye, PreviousForward, Moved;
	glm::vec2 Size;
	uint32_t bOrthographic, Normal, bUnreal;
};
static_assert(sizeof(FFrameData) == 320);

constexpr const char* Declarations = R"(#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FVectors { vec3 Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FFrameData
{
	mat4 RelativeToClip, ViewToPicture, PreviousToPicture;
	vec4 Motion;
	FVectors Positions, Normals;
	vec3 Eye, Right, Up, PreviousEye, PreviousForward, Moved;
	vec2 Size;
	uint bOrthographic, Normal, bUnreal;
};
layout(push_constant, scalar) uniform FPush { FFrameData Frame; };
)";

constexpr const char* VertexText = R"(
layout(location = 0) out vec3 OutRelative;
layout(location = 1) out vec3 OutNormal;
layout(location = 2) flat out vec3 OutGeometric;
layout(location = 3) flat out uint OutTriangle;
void main()
{
	int First = gl_VertexIndex / 3 * 3;
	vec3 A = Frame.Positions.Data[First];
	OutGeometric = normalize(cross(Frame.Positions.Data[First + 1] - A, Frame.Positions.Data[First + 2] - A));
	OutTriangle = uint(gl_VertexIndex / 3) + 1u;
	OutNormal = Frame.Normals.Data[gl_VertexIndex];
	OutRelative = Frame.Positions.Data[gl_VertexIndex] - Frame.Eye;
	gl_Position = Frame.RelativeToClip * vec4(OutRelative, 1.0);
}
)";

constexpr const char* FragmentText = R"(
layout(location = 0) in vec3 InRelative;
layout(location = 1) in vec3 InNormal;
layout(location = 2) flat in vec3 InGeometric;
layout(location = 3) flat in uint InTriangle;
layout(location = 0) out vec4 OutViewNormal;
layout(location = 1) out vec4 OutNormals;
layout(location = 2) out uint OutTriangle;
layout(location = 3) out float OutDistance;
layout(location = 4) out vec4 OutMotion;
layout(location = 5) out vec4 OutBaseColor;
layout(location = 6) out vec4 OutMaterial;
// xy: offset to where the surface was, pixels; z: its distance then.
vec3 FindMotion()
{
	vec3 Before = InRelative + Frame.Eye - Frame.Moved - Frame.PreviousEye;
	vec4 From = Frame.PreviousToPicture * vec4(Before, 1.0), To = Frame.ViewToPicture * vec4(InRelative, 1.0);
	return vec3((From.xy / From.w - To.xy / To.w) * 0.5 * Frame.Size, dot(Before, Frame.PreviousForward));
}
void StoreMaterial()
{
	float Kind = float(InTriangle / 12u);
	float Metal = mod(Kind, 2.0), Roughness = 0.25 + 0.125 * mod(Kind, 5.0);
	vec3 Color = vec3(0.8, 0.4 + 0.1 * mod(Kind, 4.0), 0.3);
	// Unreal's specular of 0.5 is F0 = 0.04, whose root is 0.2.
	OutBaseColor = vec4(Color, Frame.bUnreal != 0u ? 1.0 : Metal);
	OutMaterial = Frame.bUnreal != 0u ? vec4(Metal, 0.5, Roughness, 0.0) : vec4(Roughness, 1.0, 0.2, 1.0);
}
vec2 OctEncode(vec3 V)
{
	V /= abs(V.x) + abs(V.y) + abs(V.z);
	vec2 Folded = (1.0 - abs(V.yx)) * vec2(V.x >= 0.0 ? 1.0 : -1.0, V.y >= 0.0 ? 1.0 : -1.0);
	return V.z >= 0.0 ? V.xy : Folded;
}
void main()
{
	vec3 Forward = cross(Frame.Up, Frame.Right);
	vec3 Ng = dot(InGeometric, Frame.bOrthographic != 0u ? Forward : InRelative) > 0.0 ? -InGeometric : InGeometric;
	vec3 N = normalize(InNormal);
	N = dot(N, Ng) < 0.0 ? -N : N;
	vec3 Stored = Frame.Normal == 2u ? N : vec3(dot(N, Frame.Right), dot(N, Frame.Up), -dot(N, Forward));
	OutViewNormal = vec4(Stored * 0.5 + 0.5, 1.0);
	OutNormals = vec4(OctEncode(N), OctEncode(Ng));
	OutTriangle = InTriangle;
	OutDistance = dot(InRelative, Forward);
	vec3 Motion = FindMotion();
	OutMotion = vec4(Motion.xy * Frame.Motion.xy + Frame.Motion.zw, Motion.z, 1.0);
	StoreMaterial();
}
)";

struct FAxes
{
	glm::dvec3 Forward, Right, Up;
	explicit FAxes(const FEngineCamera& Camera)
	    : Forward(glm::normalize(Camera.Forward)),
	      Right(glm::normalize(glm::cross(Forward, Camera.Up))),
	      Up(glm::cross(Right, Forward))
	{}
};

/// Half of the picture's width and height at distance 1, or in metres.
glm::dvec2 GetHalfSize(const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size)
{
	const double HalfY = As.bOrthographic ? 0.5 * As.OrthographicHeight : std::tan(0.5 * Camera.FovY);
	return {HalfY * Size.x / Size.y, HalfY};
}

enum ETarget : size_t
{
	EngineNormalsTarget,
	NormalsTarget,
	TrianglesTarget,
	DistanceTarget,
	MotionTarget,
	BaseColorTarget,
	MaterialTarget,
};

std::array<ERTFormat, FEngineRaster::ColorCount> GetColorFormats(const FEngineConventions& As)
{
	const ERTFormat MotionFormat = As.MotionFormat == ERTFormat::Unknown ? ERTFormat::RG16_FLOAT : As.MotionFormat;
	const ERTFormat NormalFormat = As.Normals == EEngineNormals::World ? ERTFormat::RGB10A2_UNORM : ERTFormat::RGBA8_UNORM;
	return {NormalFormat, ERTFormat::RGBA16_SNORM, ERTFormat::R32_UINT, ERTFormat::R32_FLOAT, MotionFormat, ERTFormat::RGBA8_SRGB,
	    ERTFormat::RGBA8_UNORM};
}

/// Inverts what As.Layout says of stored motion.
glm::vec4 GetStoredMotion(const FEngineConventions& As, glm::uvec2 Size)
{
	glm::vec4 Out(1, 1, 0, 0);
	for (int Axis = 0; Axis < 2; ++Axis)
	{
		const float Unit = As.Layout.Motion == ERTModuleMotion::UV ? float(Size[Axis]) : 1.0f;
		Out[Axis] = 1.0f / (Unit * As.Layout.MotionScale[Axis]);
		Out[Axis + 2] = -As.Layout.MotionOffset[Axis] / As.Layout.MotionScale[Axis];
	}
	return Out;
}

glm::uvec2 GetTextureSize(const FEngineConventions& As, glm::uvec2 Size)
{
	return As.Offset == glm::uvec2(0) ? Size : Size + Size / 2u + As.Offset;
}

/// The engine's matrix, jittered, moved to the view's part of the textures, with Vulkan's y.
glm::mat4 MakeRasterMatrix(const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size)
{
	const FRTModuleProjection Projection = FEngineRaster::MakeProjection(Camera, As, Size);
	const FAxes Axes(Camera);
	glm::dvec4 Rows[4];
	for (int Row = 0; Row < 4; ++Row)
	{
		const float* const P = Projection.ViewToClip + Row * 4;
		Rows[Row] = glm::dvec4(Axes.Right * double(P[0]) + Axes.Up * double(P[1]) - Axes.Forward * double(P[2]), P[3]);
	}
	if (As.bClipYUp) { Rows[1] = -Rows[1]; }
	const glm::dvec2 View(Size), Whole(GetTextureSize(As, Size));
	for (int Axis = 0; Axis < 2; ++Axis)
	{
		const double Moved = (View[Axis] + 2.0 * (As.Offset[Axis] + double(As.Jitter[Axis]))) / Whole[Axis] - 1.0;
		Rows[Axis] = Rows[Axis] * (View[Axis] / Whole[Axis]) + Rows[3] * Moved;
	}
	return glm::transpose(glm::mat4(glm::dmat4(Rows[0], Rows[1], Rows[2], Rows[3])));
}
} // namespace

FRTModuleProjection FEngineRaster::MakeProjection(const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size)
{
	const glm::dvec2 Half = GetHalfSize(Camera, As, Size);
	FRTModuleProjection Out;
	Out.bClipYUp = As.bClipYUp;
	float* const M = Out.ViewToClip;
	M[0] = static_cast<float>(1.0 / Half.x);
	M[5] = static_cast<float>((As.bClipYUp ? 1.0 : -1.0) / Half.y);
	const double AtNear = As.bReversed ? 1.0 : 0.0, AtFar = 1.0 - AtNear;
	if (As.bOrthographic)
	{
		M[10] = static_cast<float>((AtNear - AtFar) / (As.Far - As.Near));
		M[11] = static_cast<float>(AtNear + (AtNear - AtFar) / (As.Far - As.Near) * As.Near);
		M[15] = 1.0f;
		return Out;
	}
	const double InverseFar = As.Far > 0.0 ? 1.0 / As.Far : 0.0;
	const double B = (AtNear - AtFar) / (1.0 / As.Near - InverseFar);
	M[10] = static_cast<float>(-(AtFar - B * InverseFar));
	M[11] = static_cast<float>(B);
	M[14] = -1.0f;
	return Out;
}

void FEngineRaster::MakeRay(const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size, glm::dvec2 Pixel,
    glm::dvec3& OutOrigin, glm::dvec3& OutDirection)
{
	const FAxes Axes(Camera);
	const glm::dvec2 Ndc = (Pixel - glm::dvec2(As.Jitter)) / glm::dvec2(Size) * 2.0 - 1.0;
	const glm::dvec3 Aside = Axes.Right * (Ndc.x * GetHalfSize(Camera, As, Size).x) - Axes.Up * (Ndc.y * GetHalfSize(Camera, As, Size).y);
	OutOrigin = Camera.Position + (As.bOrthographic ? Aside : glm::dvec3(0));
	OutDirection = glm::normalize(Axes.Forward + (As.bOrthographic ? glm::dvec3(0) : Aside));
}

FEngineRaster::FEngineRaster(IRTDevice& InDevice) : Device(InDevice), Compiler({{LANTERN_SOURCE_DIR "/Shaders"}, LANTERN_TEST_CACHE}) {}

FRTStatus FEngineRaster::SetScene(const FTriangleSoup& Soup)
{
	const auto Fill = [&](const std::vector<glm::vec3>& From, TRTRef<IRTBuffer>& Out) {
		const uint64_t Bytes = From.size() * sizeof(glm::vec3);
		const FRTStatus Status =
		    Device.CreateBuffer({Bytes, ERTBufferUsage::Storage, ERTMemory::Upload, "Triangles"}, Out.ReleaseAndGetAddress());
		if (Status) { std::memcpy(Out->GetMapped(), From.data(), Bytes); }
		return Status;
	};
	VertexCount = Soup.GetCount() * 3;
	const FRTStatus Status = Fill(Soup.Positions, Positions);
	return Status ? Fill(Soup.Normals, Normals) : Status;
}

FRTStatus FEngineRaster::CreatePipeline(const FEngineConventions& As, TRTRef<IRTPipeline>& Out)
{
	FShaderBinary Vertex, Fragment;
	FShaderSource Source{"Engine.vert", ERTShaderStage::Vertex, {}, std::string(Declarations) + VertexText};
	if (const FRTStatus Status = Compiler.Compile(Source, Vertex); !Status) { return Status; }
	Source = {"Engine.frag", ERTShaderStage::Fragment, {}, std::string(Declarations) + FragmentText};
	if (const FRTStatus Status = Compiler.Compile(Source, Fragment); !Status) { return Status; }
	const std::array<ERTFormat, ColorCount> Formats = GetColorFormats(As);
	FRTRasterPipelineDesc Desc;
	Desc.Vertex = Vertex.GetCode();
	Desc.Fragment = Fragment.GetCode();
	Desc.ColorFormats = Formats.data();
	Desc.ColorCount = ColorCount;
	Desc.DepthFormat = As.DepthFormat;
	Desc.Cull = ERTCull::None;
	Desc.bReversedDepth = As.bReversed;
	Desc.Name = "Engine";
	return Device.CreateRasterPipeline(Desc, Out.ReleaseAndGetAddress());
}

FRTStatus FEngineRaster::CreateTargets(const FEngineConventions& As, glm::uvec2 Size, FTargets& Out)
{
	const glm::uvec2 Whole = GetTextureSize(As, Size);
	const auto Create = [&](ERTFormat Format, ERTTextureUsage Usage, const char* Name, TRTRef<IRTTexture>& Texture) {
		return Device.CreateTexture({Whole.x, Whole.y, 1, 1, Format, Usage, Name}, Texture.ReleaseAndGetAddress());
	};
	constexpr ERTTextureUsage Color = ERTTextureUsage::Sampled | ERTTextureUsage::RenderTarget;
	const std::array<ERTFormat, ColorCount> Formats = GetColorFormats(As);
	FRTStatus Status = Create(As.DepthFormat, ERTTextureUsage::Sampled | ERTTextureUsage::Depth, "Depth", Out.Depth);
	for (size_t I = 0; Status && I < ColorCount; ++I)
	{
		constexpr const char* Names[] = {"EngineNormals", "Normals", "Triangles", "Distance", "Motion", "BaseColor", "Material"};
		const ERTTextureUsage Usage = I == TrianglesTarget ? Color | ERTTextureUsage::CopySource : Color;
		Status = Create(Formats[I], Usage, Names[I], Out.Colors[I]);
	}
	return Status;
}

/// Constants of the frame. Nothing has moved in the first one.
FRTStatus FEngineRaster::WriteFrame(const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size, FTargets& Targets) const
{
	const FEngineCamera& Before = Previous ? *Previous : Camera;
	FEngineConventions Alone = As; // the view by itself
	Alone.Offset = {0, 0};
	Alone.Jitter = {0, 0};
	const FAxes Axes(Camera);
	FFrameData Data{MakeRasterMatrix(Camera, As, Size), MakeRasterMatrix(Camera, Alone, Size), MakeRasterMatrix(Before, Alone, Size),
	    GetStoredMotion(As, Size), Positions->GetDeviceAddress(), Normals->GetDeviceAddress(), glm::vec3(Camera.Position - Shift),
	    glm::vec3(Axes.Right), glm::vec3(Axes.Up), glm::vec3(Before.Position - Shift), glm::vec3(FAxes(Before).Forward),
	    glm::vec3(Shift - PreviousShift), glm::vec2(Size), As.bOrthographic ? 1u : 0u, static_cast<uint32_t>(As.Normals),
	    As.bUnrealMaterial ? 1u : 0u};
	const FRTStatus Status =
	    Device.CreateBuffer({sizeof(Data), ERTBufferUsage::Storage, ERTMemory::Upload, "Frame"}, Targets.Frame.ReleaseAndGetAddress());
	if (Status) { std::memcpy(Targets.Frame->GetMapped(), &Data, sizeof(Data)); }
	return Status;
}

void FEngineRaster::Draw(
    IRTCommandList& List, IRTPipeline* Pipeline, const FTargets& Targets, const FEngineConventions& As, glm::uvec2 Size)
{
	using enum ERTAccess;
	FRTBarrier Barriers[ColorCount + 1] = {{nullptr, Targets.Depth.Get(), None, DepthWrite}};
	FRTColorTarget ColorTargets[ColorCount];
	for (size_t I = 0; I < ColorCount; ++I)
	{
		Barriers[I + 1] = {nullptr, Targets.Colors[I].Get(), None, RenderTarget};
		ColorTargets[I].Texture = Targets.Colors[I].Get();
	}
	List.Barriers(Barriers, ColorCount + 1);
	const glm::uvec2 Whole = GetTextureSize(As, Size);
	FRTRasterPassDesc Pass;
	Pass.Colors = ColorTargets;
	Pass.ColorCount = ColorCount;
	Pass.Depth = Targets.Depth.Get();
	Pass.ClearDepth = As.bReversed ? 0.0f : 1.0f;
	Pass.Width = Whole.x;
	Pass.Height = Whole.y;
	List.BeginRasterPass(Pass);
	List.SetPipeline(Pipeline);
	const uint64_t Frame = Targets.Frame->GetDeviceAddress();
	List.PushConstants(&Frame, sizeof(Frame));
	List.Draw(VertexCount, 1);
	List.EndRasterPass();
	for (FRTBarrier& Barrier : Barriers)
	{
		Barrier.Before = Barrier.After;
		Barrier.After = Barrier.Texture == Targets.Colors[TrianglesTarget].Get() ? CopyRead : ShaderRead;
	}
	List.Barriers(Barriers, ColorCount + 1);
}

FRTStatus FEngineRaster::MoveToOwnLayouts(IRTCommandList& List, FTargets& Targets, FRTModuleFrame& Frame)
{
	const FRTExternalState ReadOnly{VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL,
	    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
	    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_SHADER_READ_BIT};
	const FRTExternalState General{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_READ_BIT};
	IRTTexture** const Used[] = {&Frame.Depth, &Frame.Normals};
	const FRTExternalState States[] = {ReadOnly, General};
	for (int I = 0; I < 2; ++I)
	{
		FRTTextureDesc Desc = (*Used[I])->GetDesc();
		Desc.Usage = ERTTextureUsage::Sampled;
		FRTStatus Status = Device.ImportTexture(Desc, (*Used[I])->GetNative(ERTNative::Image), Targets.Imported[I].ReleaseAndGetAddress());
		if (Status) { Status = Targets.Imported[I]->SetExternalState(States[I], States[I]); }
		if (!Status) { return Status; }
		*Used[I] = Targets.Imported[I].Get();
		const FRTBarrier Barrier{nullptr, *Used[I], ERTAccess::ShaderRead, ERTAccess::External};
		List.Barriers(&Barrier, 1);
	}
	Frame.DepthAccess = Frame.NormalsAccess = ERTAccess::External;
	return FRTStatus::Success();
}

FRTStatus FEngineRaster::ReadBack(IRTCommandList& List, IRTTexture* Texture, uint32_t TexelBytes, TRTRef<IRTBuffer>& Out)
{
	const FRTTextureDesc& Desc = Texture->GetDesc();
	const uint64_t Bytes = uint64_t(Desc.Width) * Desc.Height * TexelBytes;
	const FRTStatus Status =
	    Device.CreateBuffer({Bytes, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Readback"}, Out.ReleaseAndGetAddress());
	if (!Status) { return Status; }
	List.CopyTextureToBuffer(Out.Get(), 0, Texture, 0, 0);
	const FRTBarrier Barrier{Out.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::HostRead};
	List.Barriers(&Barrier, 1);
	return Status;
}

FRTModuleFrame FEngineRaster::DescribeFrame(
    const FTargets& Targets, const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size)
{
	FRTModuleFrame Frame;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		Frame.View.Position[Axis] = Camera.Position[Axis];
		Frame.View.Forward[Axis] = static_cast<float>(Camera.Forward[Axis]);
		Frame.View.Up[Axis] = static_cast<float>(Camera.Up[Axis]);
	}
	Frame.View.Projection = MakeProjection(Camera, As, Size);
	Frame.View.Jitter[0] = As.Jitter.x;
	Frame.View.Jitter[1] = As.Jitter.y;
	Frame.Depth = As.bLinearDepth ? Targets.Colors[DistanceTarget].Get() : Targets.Depth.Get();
	Frame.Layout = As.Layout;
	if (As.bLinearDepth) { Frame.Layout.Depth = ERTModuleDepth::Linear; }
	Frame.Normals = Targets.Colors[As.Normals == EEngineNormals::Native ? NormalsTarget : EngineNormalsTarget].Get();
	if (As.Normals != EEngineNormals::Native)
	{
		Frame.Layout.Normals = ERTModuleNormals::Xyz;
		Frame.Layout.bViewSpaceNormals = As.Normals == EEngineNormals::View;
		Frame.Layout.bGeometricInZw = false;
	}
	if (As.MotionFormat != ERTFormat::Unknown) { Frame.Motion = Targets.Colors[MotionTarget].Get(); }
	if (As.bMaterials)
	{
		Frame.BaseColor = Targets.Colors[BaseColorTarget].Get();
		Frame.Material = Targets.Colors[MaterialTarget].Get();
	}
	Frame.Wanted = {As.Signal};
	Frame.OffsetX = As.Offset.x;
	Frame.OffsetY = As.Offset.y;
	Frame.Width = Size.x;
	Frame.Height = Size.y;
	return Frame;
}

namespace
{
/// Channels: of the signal, halves. Colours become the sum of red, green and blue.
void Decode(const FEngineConventions& As, glm::uvec2 Size, IRTBuffer* ShadowTexels, uint32_t Channels, IRTBuffer* TriangleTexels,
    std::vector<float>& OutVisibility, std::vector<uint32_t>& OutTriangles)
{
	const glm::uvec2 Whole = GetTextureSize(As, Size);
	OutTriangles.assign(size_t(Size.x) * Size.y, 0);
	OutVisibility.assign(size_t(Size.x) * Size.y, -1.0f);
	for (uint32_t Y = 0; Y < Size.y; ++Y)
	{
		for (uint32_t X = 0; X < Size.x; ++X)
		{
			const size_t Pixel = size_t(Y) * Size.x + X, Texel = size_t(Y + As.Offset.y) * Whole.x + X + As.Offset.x;
			OutTriangles[Pixel] = static_cast<const uint32_t*>(TriangleTexels->GetMapped())[Texel];
			if (!ShadowTexels) { continue; }
			const auto* const Halves = static_cast<const uint16_t*>(ShadowTexels->GetMapped()) + Pixel * Channels;
			OutVisibility[Pixel] = 0.0f;
			for (uint32_t Channel = 0; Channel < std::min(Channels, 3u); ++Channel)
			{
				OutVisibility[Pixel] += glm::unpackHalf1x16(Halves[Channel]);
			}
		}
	}
}
} // namespace

FRTStatus FEngineRaster::Render(IRTModuleRenderer& Renderer, const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size,
    std::vector<float>& OutVisibility, std::vector<uint32_t>& OutTriangles)
{
	TRTRef<IRTPipeline> Pipeline;
	FTargets Targets;
	TRTRef<IRTCommandList> List, Commands;
	FRTStatus Status = CreatePipeline(As, Pipeline);
	if (Status) { Status = CreateTargets(As, Size, Targets); }
	if (Status) { Status = WriteFrame(Camera, As, Size, Targets); }
	if (Status) { Status = Device.CreateCommandList("Engine", List.ReleaseAndGetAddress()); }
	if (Status) { Status = List->Begin(); }
	if (Status) { Status = Device.ImportCommandList(List->GetNative(ERTNative::CommandBuffer), Commands.ReleaseAndGetAddress()); }
	if (!Status) { return Status; }
	Draw(*List, Pipeline.Get(), Targets, As, Size);
	FRTModuleFrame Frame = DescribeFrame(Targets, Camera, As, Size);
	Frame.Commands = Commands.Get();
	if (Change) { Change(Frame); }
	if (As.bExternal) { Status = MoveToOwnLayouts(*List, Targets, Frame); }
	if (!Status) { return Status; }
	FRTModuleOutputs Outputs;
	Status = Renderer.RenderFrame(Frame, &Outputs);
	if (!Status) { return Status; }
	for (const TRTRef<IRTTexture>& Imported : Targets.Imported)
	{
		const FRTBarrier Barrier{nullptr, Imported.Get(), ERTAccess::External, ERTAccess::ShaderRead};
		if (Imported) { List->Barriers(&Barrier, 1); } // they are back in the engine's layouts
	}
	bComplete = Outputs.bComplete;
	IRTTexture* const Shadow = Outputs.Get(As.Signal);
	const uint32_t Channels = GetSignalInfo(As.Signal).Channels == 1 ? 1 : 4;
	TRTRef<IRTBuffer> ShadowTexels, TriangleTexels;
	Status = ReadBack(*List, Targets.Colors[TrianglesTarget].Get(), 4, TriangleTexels);
	if (Status && Shadow != nullptr)
	{
		FRTBarrier Barrier{nullptr, Shadow, ERTAccess::ShaderRead, ERTAccess::CopyRead};
		List->Barriers(&Barrier, 1);
		Status = ReadBack(*List, Shadow, 2 * Channels, ShadowTexels);
		std::swap(Barrier.Before, Barrier.After);
		List->Barriers(&Barrier, 1);
	}
	const FRTStatus Ended = List->End();
	IRTCommandList* const Lists[] = {List.Get()};
	FRTFence Fence = 0;
	if (Status) { Status = Ended; }
	if (Status) { Status = Device.Submit(Lists, 1, &Fence); }
	if (Status) { Status = Renderer.EndFrame(nullptr); }
	if (Status) { Status = Device.WaitFor(Fence, ~0ull); }
	if (!Status) { return Status; }
	Decode(As, Size, ShadowTexels.Get(), Channels, TriangleTexels.Get(), OutVisibility, OutTriangles);
	return Status;
}

} // namespace Lantern
