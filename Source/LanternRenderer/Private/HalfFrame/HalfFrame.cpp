// The half frame's view, G-buffer and context, and the way back to all pixels.
#include "HalfFrame/HalfFrame.h"

#include <array>
#include <cstring>

#include "HalfFrameTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarPlanes("r.RT.Debug.HalfFrame.Planes", true,
    "Planted fault. If off, pixels take what signals of half the resolution have found around them, on whatever surface.");

FShaderSource MakeReduceSource() { return MakeComputeSource("HalfFrame/Reduce.comp"); }

FShaderSource MakeUpsampleSource(const FSceneFacts& Facts, bool bPair)
{
	FShaderDefines Defines;
	AddBackPixelsDefine(Facts.bBackPixels, Defines);
	if (bPair) { Defines.emplace_back("SECOND_LOBE", "1"); }
	if (!CVarPlanes.GetOnRenderThread()) { Defines.emplace_back("NO_PLANES", "1"); }
	return MakeComputeSource("HalfFrame/Upsample.comp", std::move(Defines));
}

/// A texture of the G-buffer, and the half frame's.
struct FReduced
{
	FGraphTexture From, To;
	uint32_t FHalfTextures::*Index;
};

struct FReducedTextures
{
	std::vector<FReduced> Surfaces;
	std::array<FGraphTexture, HALF_FRAME_NUMBERS> FromNumbers, ToNumbers;
};

/// Creates the half frame's texture of each that the G-buffer has.
FReducedTextures CreateTextures(FFrameContext& Half, const FGBuffer& From, FGBuffer& Out)
{
	FReducedTextures Textures;
	const auto Create = [&](FGraphTexture Whole, ERTFormat Format, const char* Name) {
		return Whole.IsValid() ? Half.Graph.CreateTexture({Half.Width, Half.Height, Format}, Name) : FGraphTexture();
	};
	const auto Add = [&](FGraphTexture FGBuffer::*Which, ERTFormat Format, uint32_t FHalfTextures::*Index, const char* Name) {
		Out.*Which = Create(From.*Which, Format, Name);
		if ((Out.*Which).IsValid()) { Textures.Surfaces.push_back({From.*Which, Out.*Which, Index}); }
	};
	Add(&FGBuffer::Depth, ERTFormat::R32_FLOAT, &FHalfTextures::Depth, "HalfDepth");
	Add(&FGBuffer::Normals, ERTFormat::RGBA16_SNORM, &FHalfTextures::Normals, "HalfNormals");
	Add(&FGBuffer::BaseColor, ERTFormat::RGBA16_FLOAT, &FHalfTextures::BaseColor, "HalfBaseColor");
	Add(&FGBuffer::Material, ERTFormat::RGBA8_UNORM, &FHalfTextures::Material, "HalfMaterial");
	Add(&FGBuffer::BackAlbedo, ERTFormat::RGBA16_FLOAT, &FHalfTextures::BackAlbedo, "HalfBackAlbedo");
	Add(&FGBuffer::Motion, ERTFormat::RGBA32_FLOAT, &FHalfTextures::Motion, "HalfMotion");
	constexpr FGraphTexture FGBuffer::*Numbers[] = {&FGBuffer::Classes, &FGBuffer::Channels, &FGBuffer::ToonNumbers};
	static_assert(std::size(Numbers) == HALF_FRAME_NUMBERS);
	for (size_t I = 0; I < std::size(Numbers); ++I)
	{
		Textures.FromNumbers[I] = From.*Numbers[I];
		Textures.ToNumbers[I] = Out.*Numbers[I] = Create(From.*Numbers[I], ERTFormat::R8_UNORM, "HalfNumbers");
	}
	Out.bNamesObjects = From.bNamesObjects;
	return Textures;
}

void AddReducePass(
    FFrameContext& Context, const FHalfFrame& Half, const FGBuffer& GBuffer, FReducedTextures Textures, IRTPipeline* Pipeline)
{
	const FFrameContext* const Frame = &Context;
	const uint32_t Width = Half.Context.Width, Height = Half.Context.Height;
	Context.Graph.AddPass("HalfFrame", [&](FPassBuilder& Builder) -> FPassExecute {
		const auto Declare = [&](FGraphTexture From, FGraphTexture To) {
			Builder.Read(From, ERTAccess::ShaderRead);
			Builder.WriteIfRead(To, ERTAccess::StorageWrite);
		};
		for (const FReduced& Reduced : Textures.Surfaces) { Declare(Reduced.From, Reduced.To); }
		for (size_t I = 0; I < HALF_FRAME_NUMBERS; ++I)
		{
			if (Textures.ToNumbers[I].IsValid()) { Declare(Textures.FromNumbers[I], Textures.ToNumbers[I]); }
		}
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=, Textures = std::move(Textures), Offset = GBuffer.ClassesOffset](FPassContext& Pass) {
			FHalfReduceConstants C{};
			C.Pass = Frame->Pass;
			std::memset(&C.From, 0xff, sizeof(C.From));
			std::memset(&C.To, 0xff, sizeof(C.To));
			static_assert(NO_TEXTURE == 0xffffffffu);
			for (const FReduced& Reduced : Textures.Surfaces)
			{
				C.From.*Reduced.Index = GetSampledIndex(Pass, Reduced.From);
				C.To.*Reduced.Index = GetStorageIndex(Pass, Reduced.To);
			}
			for (size_t I = 0; I < HALF_FRAME_NUMBERS; ++I)
			{
				C.From.Numbers[I] = GetSampledIndex(Pass, Textures.FromNumbers[I]);
				C.To.Numbers[I] = GetStorageIndex(Pass, Textures.ToNumbers[I]);
			}
			C.NumbersOffset = Offset.x | (Offset.y << 16);
			Dispatch2D(Pass, Pipeline, C, Width, Height, HALF_FRAME_GROUP_SIZE);
		};
	});
}

/// The whole frame, but for what belongs to its pixels.
std::shared_ptr<FHalfFrame> MakeHalfFrame(const FFrameContext& Context)
{
	auto Half = std::make_shared<FHalfFrame>(FHalfFrame{Context});
	FFrameContext& Its = Half->Context;
	static_cast<FPixelsOfFrame&>(Its) = {};
	Its.bHalf = true;
	Its.History = Context.HalfHistory;
	Its.HalfHistory = nullptr;
	Its.View = MakeHalfView(Context.View);
	Its.Width = Its.View.Width;
	Its.Height = Its.View.Height;
	Its.PreviousView = nullptr;
	if (Context.PreviousView)
	{
		Half->PreviousView = MakeHalfView(*Context.PreviousView);
		Its.PreviousView = &Half->PreviousView;
	}
	return Half;
}
} // namespace

FView MakeHalfView(const FView& View)
{
	FView Half = View;
	Half.Width = DivideUp(View.Width, 2);
	Half.Height = DivideUp(View.Height, 2);
	// Sizes that are odd have pixels beyond the picture's edge.
	FViewWindow Window = View.GetWindow();
	Window.Right = Window.Left + (Window.Right - Window.Left) * (2.0 * Half.Width / View.Width);
	Window.Bottom = Window.Top + (Window.Bottom - Window.Top) * (2.0 * Half.Height / View.Height);
	Half.Window = Window;
	Half.Jitter = (View.Jitter + 0.5f) * 0.5f;
	return Half;
}

bool AreHalfFrameShadersReady(const FFrameContext& Context, bool bPair)
{
	const bool bReduce = RequireCompute(Context, MakeReduceSource()) != nullptr; // both are asked for at once
	return RequireCompute(Context, MakeUpsampleSource(Context.Facts, bPair)) && bReduce;
}

FHalfFrame* RequireHalfFrame(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (Context.Half) { return Context.Half.get(); }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeReduceSource());
	if (!Pipeline) { return nullptr; }
	std::shared_ptr<FHalfFrame> Half = MakeHalfFrame(Context);
	if (FRTStatus S = Context.Owner->GetUploads().Allocate(sizeof(FViewConstants), Half->ViewConstants); !S)
	{
		Context.Fail(S);
		return nullptr;
	}
	Half->Context.Pass.View = Half->ViewConstants.Address;
	AddReducePass(Context, *Half, GBuffer, CreateTextures(Half->Context, GBuffer, Half->GBuffer), Pipeline);
	Context.Half = std::move(Half);
	return Context.Half.get();
}

void WriteHalfConstants(const FHalfFrame& Half, uint32_t FrameIndex)
{
	FViewConstants C = MakeViewConstants(Half.Context.View, Half.Context.Scene.GetOrigin(), Half.Context.PreviousView);
	C.FrameIndex = FrameIndex;
	std::memcpy(Half.ViewConstants.Data, &C, sizeof(C));
}

FLobes AddUpsample(FFrameContext& Context, const FGBuffer& GBuffer, const char* Name, const FLobes& Lobes)
{
	const std::array<FGraphTexture, 2> Inputs = {
	    Lobes.Diffuse.IsValid() ? Lobes.Diffuse : Lobes.Specular, Lobes.Diffuse.IsValid() ? Lobes.Specular : FGraphTexture()};
	if (!Inputs[0].IsValid()) { return Lobes; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeUpsampleSource(Context.Facts, Inputs[1].IsValid()));
	if (!Pipeline) { return {}; }
	std::array<FGraphTexture, 2> Outputs;
	for (size_t I = 0; I < 2; ++I)
	{
		if (!Inputs[I].IsValid()) { continue; }
		FGraphTextureDesc Desc = Context.Graph.GetDesc(Inputs[I]);
		Desc.Width = Context.Width;
		Desc.Height = Context.Height;
		Outputs[I] = Context.Graph.CreateTexture(Desc, Name);
	}
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass(Name, [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals, Inputs[0], Inputs[1]})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		for (const FGraphTexture Output : Outputs)
		{
			if (Output.IsValid()) { Builder.Write(Output, ERTAccess::StorageWrite); }
		}
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FHalfUpsampleConstants C{};
			C.Pass = Frame->Pass;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			for (size_t I = 0; I < 2; ++I)
			{
				C.Inputs[I] = GetSampledIndex(Pass, Inputs[I]);
				C.Outputs[I] = GetStorageIndex(Pass, Outputs[I]);
			}
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, HALF_FRAME_GROUP_SIZE);
		};
	});
	if (Context.Half->Context.DebugPicture.IsValid()) { Context.DebugPicture = Context.Half->Context.DebugPicture; }
	return Lobes.Diffuse.IsValid() ? FLobes{Outputs[0], Outputs[1]} : FLobes{{}, Outputs[0]};
}

void ListHalfFrameShaders(const FSceneFacts& Facts, bool bPair, std::vector<FShaderSource>& Out)
{
	Out.push_back(MakeReduceSource());
	Out.push_back(MakeUpsampleSource(Facts, bPair));
}

} // namespace Lantern
