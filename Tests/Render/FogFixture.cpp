// Light in fog, read back.
#include "FogFixture.h"

#include <cmath>

#include <glm/gtc/packing.hpp>

#include "LanternRenderer/Frame.h"

namespace Lantern
{

void FFogPicture::ForEach(const std::function<void(glm::uvec3)>& Visit) const
{
	for (uint32_t Z = 0; Z < Grid.Slices; ++Z)
	{
		for (uint32_t Y = 0; Y < Grid.Rows; ++Y)
		{
			for (uint32_t X = 0; X < Grid.Columns; ++X) { Visit({X, Y, Z}); }
		}
	}
}

glm::dvec3 FroxelToWorld(const FView& View, const FFogGrid& Grid, glm::dvec3 Place)
{
	const double Distance = double(Grid.Distance) * (std::pow(65.0, Place.z / double(Grid.Slices)) - 1.0) / 64.0;
	const FViewWindow Window = View.GetWindow();
	const glm::dvec2 At = glm::dvec2(Place) * double(Grid.PixelSize) / glm::dvec2(View.Width, View.Height);
	const double X = Window.Left + (Window.Right - Window.Left) * At.x, Y = Window.Top + (Window.Bottom - Window.Top) * At.y;
	const glm::dvec3 Forward = glm::normalize(glm::dvec3(View.Forward)), Right = glm::normalize(glm::cross(Forward, glm::dvec3(View.Up)));
	const glm::dvec3 Up = glm::cross(Right, Forward);
	return View.Position + Forward * Distance + (Right * X + Up * Y) * (Window.bOrthographic ? 1.0 : Distance);
}

void FFogTest::SetUp()
{
	FRenderTest::SetUp();
	GetEngine().Signals.bFog = true;
}

void FFogTest::TearDown()
{
	GetEngine().Signals = {};
	FRenderTest::TearDown();
}

void FFogTest::AddRead(FFrameContext& Context, FGraphTexture Texture, TRTRef<IRTBuffer>& Out)
{
	if (!Texture.IsValid()) { return; }
	const FGraphTextureDesc Desc = Context.Graph.GetDesc(Texture);
	const uint64_t Bytes = uint64_t(Desc.Width) * Desc.Height * BytesPerTexel(Desc.Format);
	ASSERT_OK(GetDevice().CreateBuffer({Bytes, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Fog"}, Out.ReleaseAndGetAddress()));
	const FGraphBuffer Target = Context.Graph.ImportBuffer(Out.Get(), ERTAccess::None, ERTAccess::HostRead, "Fog");
	Context.Graph.AddPass("ReadFog", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Texture, ERTAccess::CopyRead);
		Builder.Write(Target, ERTAccess::CopyWrite);
		return [=](FPassContext& Pass) { Pass.Commands().CopyTextureToBuffer(Pass.GetBuffer(Target), 0, Pass.GetTexture(Texture), 0, 0); };
	});
}

FFogPicture FFogTest::RenderFog(const FView& View, uint32_t Frames)
{
	FFogPicture Picture;
	TRTRef<IRTBuffer> Visibility, Light;
	GetEngine().ExtraPasses = [&](FFrameContext& Context, const FGBuffer&, const FFrameOutputs& Frame) {
		Picture.Grid = Frame.Fog.Grid;
		AddRead(Context, Frame.Fog.Visibility, Visibility);
		AddRead(Context, Frame.Fog.Light, Light);
	};
	RenderFrames(View, Frames);
	if (Visibility)
	{
		const auto* const Bytes = static_cast<const uint8_t*>(Visibility->GetMapped());
		for (uint64_t I = 0; I < Visibility->GetDesc().Size; ++I) { Picture.Visibility.push_back(float(Bytes[I]) / 255.0f); }
	}
	Picture.Light = UnpackHalves(Light);
	return Picture;
}

void FFogTest::RenderFrames(const FView& View, uint32_t Frames)
{
	for (uint32_t Frame = 0; Frame < Frames; ++Frame)
	{
		EXPECT_OK(GetEngine().RenderFrame(View, 0.0, {}, nullptr));
		EXPECT_OK(GetEngine().GetRenderer().WaitForAll());
	}
	GetEngine().ExtraPasses = {};
}

std::vector<glm::vec3> FFogTest::UnpackHalves(const TRTRef<IRTBuffer>& Buffer)
{
	std::vector<glm::vec3> Out;
	if (!Buffer) { return Out; }
	const auto* const Halves = static_cast<const uint16_t*>(Buffer->GetMapped());
	for (uint64_t I = 0; I < Buffer->GetDesc().Size / 8; ++I)
	{
		Out.emplace_back(
		    glm::unpackHalf1x16(Halves[4 * I]), glm::unpackHalf1x16(Halves[4 * I + 1]), glm::unpackHalf1x16(Halves[4 * I + 2]));
	}
	return Out;
}

FFogPicture FFogTest::RenderVolume(const FView& View, uint32_t Frames, std::vector<glm::vec3>& OutMoments)
{
	FFogPicture Picture;
	TRTRef<IRTBuffer> Light, Moment;
	GetEngine().ExtraPasses = [&](FFrameContext& Context, const FGBuffer&, const FFrameOutputs& Frame) {
		Picture.Grid = Frame.IndirectVolume.Grid;
		AddRead(Context, Frame.IndirectVolume.Light, Light);
		AddRead(Context, Frame.IndirectVolume.Moment, Moment);
	};
	RenderFrames(View, Frames);
	Picture.Light = UnpackHalves(Light);
	OutMoments = UnpackHalves(Moment);
	return Picture;
}

FFogPicture FFogTest::MeanFog(const FView& View, uint32_t Frames)
{
	FFogPicture Mean = RenderFog(View);
	for (uint32_t Frame = 1; Frame < Frames; ++Frame)
	{
		const FFogPicture Next = RenderFog(View);
		for (size_t I = 0; I < Mean.Visibility.size(); ++I) { Mean.Visibility[I] += Next.Visibility[I]; }
		for (size_t I = 0; I < Mean.Light.size(); ++I) { Mean.Light[I] += Next.Light[I]; }
	}
	for (float& Value : Mean.Visibility) { Value /= float(Frames); }
	for (glm::vec3& Value : Mean.Light) { Value /= float(Frames); }
	return Mean;
}

} // namespace Lantern
