// The light mask, read back, and the scene that its tests look at.
#include "LightMaskFixture.h"

#include <cmath>
#include <cstring>

#include <glm/gtc/matrix_transform.hpp>

#include "LanternRenderer/Frame.h"

namespace Lantern
{

namespace
{
constexpr const char* Reader = R"(#version 460
#include "Library/UintTextures.glsl"
#define LIGHT_MASK_TEXTURE utexture2D
#include "LocalLights/LightMask.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FOutput { float Data[]; };
layout(push_constant, scalar) uniform FPush { FAddress Output; uint Visibility, Lights, Width, Height, Number; };
void main()
{
	uvec2 Pixel = gl_GlobalInvocationID.xy;
	if (any(greaterThanEqual(Pixel, uvec2(Width, Height)))) { return; }
	float Seen = SampleLightMask(UintTextures[Visibility], UintTextures[Lights], ivec2(Pixel), Number);
	FOutput(Output).Data[Pixel.y * Width + Pixel.x] = Seen;
}
)";

struct FReaderPush
{
	uint64_t Output = 0;
	uint32_t Visibility = 0, Lights = 0, Width = 0, Height = 0, Number = 0;
};
} // namespace

uint32_t FMaskPicture::FindSlot(uint32_t X, uint32_t Y, uint32_t Number) const
{
	uint32_t Slot = 0;
	while (Slot < 8 && GetNumber(X, Y, Slot) != Number) { ++Slot; }
	return Slot;
}

uint32_t FMaskPicture::Get(uint32_t X, uint32_t Y, uint32_t Number) const
{
	const uint32_t Slot = FindSlot(X, Y, Number);
	return Slot < 8 ? (Visibility[size_t(Y) * Width + X] >> (4 * Slot)) & 15 : 0;
}

double FMaskPicture::GetMean(uint32_t Number) const
{
	double Sum = 0.0;
	for (uint32_t Y = 0; Y < Height; ++Y)
	{
		for (uint32_t X = 0; X < Width; ++X) { Sum += Get(X, Y, Number) / 15.0; }
	}
	return Sum / (double(Width) * Height);
}

void FLightMaskTest::SetUp()
{
	FSignalTest::SetUp();
	SetVariable("r.RT.Lights.Denoise", "0");      // what rays say, and nothing else
	SetVariable("r.RT.Rays.QueuePerPixel", "12"); // all that are asked for
	GetEngine().Signals.bLightMask = true;
}

void FLightMaskTest::TearDown()
{
	GetEngine().Signals = {};
	GetEngine().ExtraPasses = {};
	FSignalTest::TearDown();
}

void FLightMaskTest::LoadBars()
{
	FTestScene Scene("bars");
	const int32_t Both = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Both, 8.0f)}));
	const int32_t Bar = Scene.AddMesh({{Both, {{-0.2f, 1.2f, 3}, {0.2f, 1.2f, 3}, {0.2f, 1.2f, -3}, {-0.2f, 1.2f, -3}}}});
	for (int I = 0; I < 7; ++I) { Scene.AddNode(Bar, glm::translate(glm::dmat4(1), glm::dvec3(-2.4 + 0.8 * I, 0, 0))); }
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(0));
}

std::vector<FLightId> FLightMaskTest::AddLamps(uint32_t Count, float Radius)
{
	std::vector<FLightId> Ids;
	for (uint32_t I = 0; I < Count; ++I)
	{
		const double Angle = 0.3 + 2.4 * I, Far = 2.2 * std::sqrt((I + 0.5) / Count);
		const glm::dvec3 Position(Far * std::cos(Angle), 1.6 + 0.1 * (I % 7), Far * std::sin(Angle));
		Ids.push_back(GetWorld().AddLight(MakeLamp(Position, glm::vec3(1.0f + 0.5f * float(I % 3)) * (4.0f / float(Count)), Radius)));
	}
	return Ids;
}

FView FLightMaskTest::LookAtFloor(uint32_t Width, uint32_t Height, double Aside)
{
	return LookAt({Aside, 1.1, 1.2}, {Aside, 0, 0}, 0.8f, Width, Height);
}

double FLightMaskTest::LightFloor(const FView& View, uint32_t X, uint32_t Y, const FSceneLight& Lamp)
{
	const FViewWindow Window = View.GetWindow();
	const glm::dvec2 At = (glm::dvec2(X, Y) + 0.5) / glm::dvec2(View.Width, View.Height);
	const glm::dvec3 Forward = glm::normalize(glm::dvec3(View.Forward)), Right = glm::normalize(glm::cross(Forward, glm::dvec3(View.Up)));
	const glm::dvec3 Up = glm::cross(Right, Forward);
	const glm::dvec3 Ray =
	    Forward + Right * (Window.Left + (Window.Right - Window.Left) * At.x) + Up * (Window.Top + (Window.Bottom - Window.Top) * At.y);
	const glm::dvec3 To = Lamp.Position - (View.Position - Ray * (View.Position.y / Ray.y));
	const double Distance = glm::length(To);
	return double(Lamp.Color.g) * To.y / (Distance * Distance * Distance) / 3.14159265358979;
}

void FLightMaskTest::AddRead(FFrameContext& Context, FGraphTexture Texture, TRTRef<IRTBuffer>& Out)
{
	if (!Texture.IsValid()) { return; }
	const FGraphTextureDesc Desc = Context.Graph.GetDesc(Texture);
	const uint64_t Bytes = uint64_t(Desc.Width) * Desc.Height * BytesPerTexel(Desc.Format);
	ASSERT_OK(GetDevice().CreateBuffer({Bytes, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Mask"}, Out.ReleaseAndGetAddress()));
	const FGraphBuffer Target = Context.Graph.ImportBuffer(Out.Get(), ERTAccess::None, ERTAccess::HostRead, "Mask");
	Context.Graph.AddPass("ReadMask", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Texture, ERTAccess::CopyRead);
		Builder.Write(Target, ERTAccess::CopyWrite);
		return [=](FPassContext& Pass) { Pass.Commands().CopyTextureToBuffer(Pass.GetBuffer(Target), 0, Pass.GetTexture(Texture), 0, 0); };
	});
}

std::vector<float> FLightMaskTest::ReadByShader(const FView& View, uint32_t Number)
{
	IRTPipeline* Pipeline = nullptr;
	EXPECT_OK(GetEngine().GetRenderer().GetPipelines().Get({"MaskReader.comp", ERTShaderStage::Compute, {}, Reader}, Pipeline));
	const uint64_t Bytes = uint64_t(View.Width) * View.Height * sizeof(float);
	TRTRef<IRTBuffer> Out;
	EXPECT_OK(GetDevice().CreateBuffer({Bytes, ERTBufferUsage::Storage, ERTMemory::Readback, "Read"}, Out.ReleaseAndGetAddress()));
	if (!Pipeline || !Out) { return {}; }
	GetEngine().ExtraPasses = [&](FFrameContext& Context, const FGBuffer&, const FFrameOutputs& Frame) {
		if (!Frame.LightMask.IsValid()) { return; }
		const FLightMask Mask = Frame.LightMask;
		const FGraphBuffer Target = Context.Graph.ImportBuffer(Out.Get(), ERTAccess::None, ERTAccess::HostRead, "Read");
		Context.Graph.AddPass("ReadMask", [&](FPassBuilder& Builder) -> FPassExecute {
			for (const FGraphTexture Texture : {Mask.Visibility, Mask.Lights}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
			Builder.Write(Target, ERTAccess::StorageWrite);
			return [=](FPassContext& Pass) {
				const FReaderPush Push{Pass.GetBuffer(Target)->GetDeviceAddress(), Pass.GetTexture(Mask.Visibility)->GetSampledIndex(),
				    Pass.GetTexture(Mask.Lights)->GetSampledIndex(), View.Width, View.Height, Number};
				Pass.Commands().SetPipeline(Pipeline);
				Pass.Commands().PushConstants(&Push, sizeof(Push));
				Pass.Commands().Dispatch((View.Width + 7) / 8, (View.Height + 7) / 8, 1);
			};
		});
	};
	EXPECT_OK(GetEngine().RenderFrame(View, 0.0, {}, nullptr));
	EXPECT_OK(GetEngine().GetRenderer().WaitForAll());
	GetEngine().ExtraPasses = {};
	std::vector<float> Read(size_t(View.Width) * View.Height);
	std::memcpy(Read.data(), Out->GetMapped(), Bytes);
	return Read;
}

FMaskPicture FLightMaskTest::RenderMask(const FView& View)
{
	FMaskPicture Picture;
	TRTRef<IRTBuffer> Visibility, Lights;
	GetEngine().ExtraPasses = [&](FFrameContext& Context, const FGBuffer&, const FFrameOutputs& Frame) {
		if (!Frame.LightMask.IsValid()) { return; }
		Picture.Width = View.Width;
		Picture.Height = View.Height;
		Picture.LightsWidth = Context.Graph.GetDesc(Frame.LightMask.Lights).Width;
		Picture.LightsHeight = Context.Graph.GetDesc(Frame.LightMask.Lights).Height;
		AddRead(Context, Frame.LightMask.Visibility, Visibility);
		AddRead(Context, Frame.LightMask.Lights, Lights);
	};
	FFrameCapture Capture;
	if (!GetEngine().Signals.bNothingElse) { Capture.Signals.Add(ESignal::LocalDiffuse); }
	FCapturedFrame Captured;
	EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Captured));
	EXPECT_OK(GetEngine().GetRenderer().WaitForAll());
	GetEngine().ExtraPasses = {};
	if (!GetEngine().Signals.bNothingElse) { Picture.Diffuse = Captured.Get(ESignal::LocalDiffuse); }
	const auto Copy = [](const TRTRef<IRTBuffer>& From, std::vector<uint32_t>& To) {
		if (!From) { return; }
		To.resize(From->GetDesc().Size / 4);
		std::memcpy(To.data(), From->GetMapped(), To.size() * 4);
	};
	Copy(Visibility, Picture.Visibility);
	Copy(Lights, Picture.Lights);
	return Picture;
}

} // namespace Lantern
