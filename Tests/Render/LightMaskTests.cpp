// The light mask for hosts that light by themselves: which light has which slot, what pixels see of it, and that nothing is lost or counted
// twice beside it.
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <glm/gtc/matrix_transform.hpp>

#include "LightMaskFixture.h"

namespace Lantern
{

namespace
{
constexpr uint32_t Lamps8 = 8;

/// Means over frames and pixels, green: what a host's light brings by the mask, what the rest brings, and what all lamps do.
struct FSum
{
	double Host = 0.0, Rest = 0.0, All = 0.0;
	double Ratio() const { return (Host + Rest) / All; }
};

class FLightMaskRenderTest : public FLightMaskTest
{
protected:
	/// Numbers of lights.
	static std::vector<uint32_t> GetNumbers(const std::vector<FLightId>& Ids)
	{
		std::vector<uint32_t> Numbers;
		for (const FLightId Id : Ids) { Numbers.push_back(MakeLightNumber(Id)); }
		return Numbers;
	}
	/// What Count lamps bring, from pictures of eight at a time, which have a ray each and no noise.
	FImage RenderInEights(const std::vector<FLightId>& Ids, const FView& View)
	{
		GetEngine().Signals.bLightMask = false;
		SetVariable("r.RT.Lights.Exact", "8");
		std::vector<FSceneLight> Lamps;
		for (const FLightId Id : Ids) { Lamps.push_back(GetWorld().GetLights().Get(Id)); }
		FImage Sum;
		for (size_t First = 0; First < Ids.size(); First += Lamps8)
		{
			for (size_t I = 0; I < Ids.size(); ++I)
			{
				FSceneLight Lamp = Lamps[I];
				if (I / Lamps8 != First / Lamps8) // no list has it
				{
					Lamp.Position.y = 100.0;
					Lamp.Range = 0.01f;
				}
				GetWorld().SetLight(Ids[I], Lamp);
			}
			const FImage Part = RenderSignal(ESignal::LocalDiffuse, View);
			if (First == 0) { Sum = Part; }
			else
			{
				for (size_t I = 0; I < Sum.Pixels.size(); ++I) { Sum.Pixels[I] += Part.Pixels[I]; }
			}
		}
		for (size_t I = 0; I < Ids.size(); ++I) { GetWorld().SetLight(Ids[I], Lamps[I]); }
		GetEngine().Signals.bLightMask = true;
		return Sum;
	}
	/// All: what the lamps bring.
	FSum SumUp(const std::vector<FLightId>& Ids, const FView& View, uint32_t Frames, double All)
	{
		std::unordered_map<uint32_t, FSceneLight> Lamps; // by number
		for (const FLightId Id : Ids) { Lamps[MakeLightNumber(Id)] = GetWorld().GetLights().Get(Id); }
		FSum Sum;
		Sum.All = All;
		const uint32_t Pixels = View.Width * View.Height;
		for (uint32_t Frame = 0; Frame < Frames; ++Frame)
		{
			const FMaskPicture Picture = RenderMask(View);
			EXPECT_EQ(Picture.Width, View.Width);
			if (Picture.Width != View.Width) { return Sum; }
			Sum.Rest += MeanGreen(Picture.Diffuse) / Frames;
			for (uint32_t I = 0; I < Pixels * Lamps8; ++I)
			{
				const uint32_t X = I / Lamps8 % View.Width, Y = I / Lamps8 / View.Width, Number = Picture.GetNumber(X, Y, I % Lamps8);
				const auto Lamp = Lamps.find(Number);
				EXPECT_EQ(Lamp != Lamps.end(), Number != 0);
				if (Lamp == Lamps.end()) { continue; }
				Sum.Host += Picture.Get(X, Y, Number) / 15.0 * LightFloor(View, X, Y, Lamp->second) / (double(Pixels) * Frames);
			}
		}
		return Sum;
	}
};

// A lamp over a plate is dark everywhere, whichever of the eight it is, and no other is.
TEST_F(FLightMaskRenderTest, EachOfEightBlockedInTurn)
{
	FTestScene Scene("plate");
	const int32_t Both = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Both, 8.0f), FTestScene::MakeFloor(Both, 0.5f, 1.9f, {3, 0})}));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(0));
	FSceneLight Lamp;
	Lamp.Color = glm::vec3(1);
	std::vector<FLightId> Ids;
	for (uint32_t I = 0; I < Lamps8; ++I) { Ids.push_back(GetWorld().AddLight(Lamp)); }
	const std::vector<uint32_t> Numbers = GetNumbers(Ids);
	const FView View = LookAtFloor(40, 24);
	for (const char* const Rate : {"0", "1", "2"})
	{
		SetVariable("r.RT.Lights.Rate", Rate);
		for (uint32_t Blocked = 0; Blocked < Lamps8; ++Blocked)
		{
			for (uint32_t I = 0; I < Lamps8; ++I)
			{
				const double Angle = 2.0 * 3.14159265 / Lamps8 * ((I + Lamps8 - Blocked) % Lamps8);
				Lamp.Position = {3.0 * std::cos(Angle), 2.0, 3.0 * std::sin(Angle)};
				GetWorld().SetLight(Ids[I], Lamp);
			}
			const FMaskPicture Picture = RenderMask(View);
			ASSERT_EQ(Picture.Visibility.size(), 40u * 24u);
			for (uint32_t Pixel = 0; Pixel < 40 * 24; ++Pixel)
			{
				for (uint32_t I = 0; I < Lamps8; ++I)
				{
					ASSERT_EQ(Picture.Get(Pixel % 40, Pixel / 40, Numbers[I]), I == Blocked ? 0u : 15u) << Blocked << " at " << Pixel;
				}
			}
			EXPECT_EQ(MeanGreen(Picture.Diffuse), 0.0) << "all are in the mask";
		}
	}
}

using FLightMaskSlowTest = FLightMaskRenderTest;

// What is in the mask and what is not are all light, at each rate.
TEST_F(FLightMaskSlowTest, MaskAndRestAreAllLight)
{
	ASSERT_NO_FATAL_FAILURE(LoadBars());
	const FView View = LookAtFloor(64, 36);
	for (const uint32_t Count : {7u, 9u, 14u})
	{
		const std::vector<FLightId> Ids = AddLamps(Count);
		for (const char* const Rate : {"0", "1", "2"})
		{
			SetVariable("r.RT.Lights.Rate", "0");
			const double All = MeanGreen(RenderInEights(Ids, View));
			SetVariable("r.RT.Lights.Rate", Rate);
			const FSum Sum = SumUp(Ids, View, Count > Lamps8 ? 24 : 4, All);
			PrintFigure(fmt::format(
			    "{} lamps, rate {}: mask {:.4f} and rest {:.4f} of {:.4f}: {:.4f}", Count, Rate, Sum.Host, Sum.Rest, Sum.All, Sum.Ratio()));
			EXPECT_NEAR(Sum.Ratio(), 1.0, 0.01);
			EXPECT_EQ(Sum.Rest > 0.0, Count > Lamps8);
			EXPECT_GT(Sum.Host, 0.5 * Sum.All) << "the brightest are in the mask";
		}
		for (const FLightId Id : Ids) { GetWorld().RemoveLight(Id); }
	}
}

// Regions draw lists of more lights than they hold. What the mask takes of them has no influence on what is drawn.
TEST_F(FLightMaskRenderTest, MaskOfDrawnListsAndRestAreAllLight)
{
	ASSERT_NO_FATAL_FAILURE(LoadBars());
	const FView View = LookAtFloor(32, 32);
	const std::vector<FLightId> Ids = AddLamps(320);
	const double All = MeanGreen(RenderInEights(Ids, View));
	(void)SumUp(Ids, View, 4, All); // tiles remember lights
	const FSum Sum = SumUp(Ids, View, 96, All);
	PrintFigure(fmt::format("320 lamps: mask {:.4f} and rest {:.4f} of {:.4f}: {:.4f}", Sum.Host, Sum.Rest, Sum.All, Sum.Ratio()));
	EXPECT_NEAR(Sum.Ratio(), 1.0, 0.01);
	EXPECT_GT(Sum.Host, 0.02 * Sum.All);
}

TEST_F(FLightMaskRenderTest, LampsKeepTheirSlots)
{
	ASSERT_NO_FATAL_FAILURE(LoadBars());
	const FView View = LookAtFloor(64, 36);
	for (const char* const Order : {"1", "0"})
	{
		SetVariable("r.RT.Debug.Lights.MaskOrder", Order);
		std::vector<FLightId> Ids = AddLamps(5);
		const std::vector<uint32_t> Numbers = GetNumbers(Ids);
		FView First = View;
		First.bCut = true;
		const FMaskPicture Before = RenderMask(First);
		GetWorld().RemoveLight(Ids[1]);
		const FMaskPicture Without = RenderMask(View);
		Ids[1] = GetWorld().AddLight(GetWorld().GetLights().Get(Ids[0]));
		const uint32_t New = MakeLightNumber(Ids[1]);
		EXPECT_NE(New, Numbers[1]) << "it took the index of another";
		const FMaskPicture After = RenderMask(View);
		size_t Moved = 0;
		for (uint32_t X = 0; X < 64; X += 8)
		{
			for (uint32_t Y = 0; Y < 36; Y += 8)
			{
				for (const uint32_t I : {0u, 2u, 3u, 4u})
				{
					const uint32_t Slot = Before.FindSlot(X, Y, Numbers[I]);
					ASSERT_LT(Slot, 8u);
					Moved += Without.FindSlot(X, Y, Numbers[I]) != Slot || After.FindSlot(X, Y, Numbers[I]) != Slot ? 1 : 0;
				}
				EXPECT_EQ(Without.FindSlot(X, Y, Numbers[1]), 8u);
				EXPECT_LT(After.FindSlot(X, Y, New), 8u);
			}
		}
		if (*Order == '1') { EXPECT_EQ(Moved, 0u); }
		else { EXPECT_GT(Moved, 40u) << "the planted fault is not seen"; }
		for (const FLightId Id : Ids) { GetWorld().RemoveLight(Id); }
	}
}

// A lamp of short range is listed in some tiles, so that two others have other slots there by order. As the camera moves, the hidden one of
// these gets nothing of the other's history.
TEST_F(FLightMaskRenderTest, HistoriesAreMatchedByLight)
{
	FTestScene Scene("hidden");
	const int32_t Both = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Both, 8.0f), FTestScene::MakeFloor(Both, 4.0f, 2.0f)}));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(0));
	SetVariable("r.RT.Lights.Denoise", "1");
	SetVariable("r.RT.Lights.HistorySeconds", "10");
	FSceneLight Near;
	Near.Type = LIGHT_SPHERE;
	Near.Position = {-0.6, 0.5, 0};
	Near.Size = {0.05, 0};
	Near.Color = glm::vec3(100);
	Near.Range = 0.7f;
	GetWorld().AddLight(Near);
	FSceneLight Open = Near;
	Open.Position = {0.8, 1.6, 0.5};
	Open.Range = 0.0f;
	GetWorld().AddLight(Open);
	FSceneLight Hidden = Open;
	Hidden.Position = {0, 2.6, 0};
	const uint32_t Number = MakeLightNumber(GetWorld().AddLight(Hidden));
	for (const char* const Order : {"1", "0"})
	{
		SetVariable("r.RT.Debug.Lights.MaskOrder", Order);
		uint32_t Most = 0;
		for (int Frame = 0; Frame < 24; ++Frame)
		{
			FView View = LookAtFloor(64, 36, 0.01 * Frame);
			View.bCut = Frame == 0;
			const FMaskPicture Picture = RenderMask(View);
			ASSERT_EQ(Picture.Width, 64u);
			for (uint32_t Pixel = 0; Pixel < 64 * 36; ++Pixel) { Most = std::max(Most, Picture.Get(Pixel % 64, Pixel / 64, Number)); }
		}
		if (*Order == '1') { EXPECT_EQ(Most, 0u); }
		else { EXPECT_GT(Most, 5u) << "the planted fault is not seen"; }
	}
}

// Half shadows become smooth, and keep their mean. A lamp that is hidden from one frame to the next is dark soon.
TEST_F(FLightMaskRenderTest, HalfShadowsAreAccumulated)
{
	ASSERT_NO_FATAL_FAILURE(LoadBars());
	const std::vector<FLightId> Ids = AddLamps(3, 0.25f);
	const std::vector<uint32_t> Numbers = GetNumbers(Ids);
	const FView View = LookAtFloor(64, 36);
	struct FPlayed
	{
		double Mean = 0.0, Sigma = 0.0;
	};
	const auto Play = [&](const char* Denoise) {
		SetVariable("r.RT.Lights.Denoise", Denoise);
		FView Moving = View;
		Moving.DeltaSeconds = 1.0f / 60.0f;
		std::vector<double> Sums(64 * 36), Squares(64 * 36);
		for (int Frame = 0; Frame < 96; ++Frame)
		{
			Moving.bCut = Frame == 0;
			const FMaskPicture Picture = RenderMask(Moving);
			for (uint32_t Pixel = 0; Pixel < 64 * 36 && Frame >= 32; ++Pixel)
			{
				const double Value = Picture.Get(Pixel % 64, Pixel / 64, Numbers[0]) / 15.0;
				Sums[Pixel] += Value / 64.0;
				Squares[Pixel] += Value * Value / 64.0;
			}
		}
		FPlayed Out;
		for (size_t Pixel = 0; Pixel < Sums.size(); ++Pixel)
		{
			Out.Mean += Sums[Pixel] / double(Sums.size());
			Out.Sigma += std::sqrt(std::max(0.0, Squares[Pixel] - Sums[Pixel] * Sums[Pixel])) / double(Sums.size());
		}
		return Out;
	};
	const FPlayed Raw = Play("0"), Smooth = Play("1");
	PrintFigure(fmt::format("mean {:.4f}, of rays {:.4f}; sigma {:.4f}, of rays {:.4f}", Smooth.Mean, Raw.Mean, Smooth.Sigma, Raw.Sigma));
	EXPECT_NEAR(Smooth.Mean / Raw.Mean, 1.0, 0.005);
	EXPECT_LT(3.0 * Smooth.Sigma, Raw.Sigma);
	// A bar moves under the lamp. Its shadow's place is known.
	const double Still = RenderMask(View).GetMean(Numbers[0]);
	for (size_t I = 1; I < GetScene().GetDraws().size(); ++I)
	{
		GetScene().SetTransform(I, glm::translate(glm::dmat4(1), glm::dvec3(50, 0, 0)));
	}
	double Lit = 0.0;
	for (int Frame = 0; Frame < 4; ++Frame) { Lit = RenderMask(View).GetMean(Numbers[0]); }
	PrintFigure(fmt::format("mean {:.4f}; bars gone, after four frames {:.4f}", Still, Lit));
	EXPECT_LT(Still, 0.9);
	EXPECT_GT(Lit, 0.97);
}

TEST_F(FLightMaskRenderTest, LampsWithoutShadowAreSeen)
{
	ASSERT_NO_FATAL_FAILURE(LoadBars());
	const std::vector<FLightId> Ids = AddLamps(4);
	FSceneLight Open = GetWorld().GetLights().Get(Ids[2]);
	Open.bCastsShadow = false;
	GetWorld().SetLight(Ids[2], Open);
	const FMaskPicture Picture = RenderMask(LookAtFloor(40, 24));
	EXPECT_EQ(Picture.GetMean(MakeLightNumber(Ids[2])), 1.0);
	EXPECT_LT(Picture.GetMean(MakeLightNumber(Ids[1])), 0.9) << "there are bars";
}

TEST_F(FLightMaskRenderTest, HostsReadItByTheShader)
{
	ASSERT_NO_FATAL_FAILURE(LoadBars());
	const std::vector<FLightId> Ids = AddLamps(12);
	const FView View = LookAtFloor(61, 35);
	const FMaskPicture Picture = RenderMask(View);
	for (const FLightId Id : Ids)
	{
		const uint32_t Number = MakeLightNumber(Id);
		const std::vector<float> Read = ReadByShader(View, Number);
		ASSERT_EQ(Read.size(), 61u * 35u);
		for (uint32_t Pixel = 0; Pixel < 61 * 35; ++Pixel)
		{
			ASSERT_NEAR(Read[Pixel], Picture.Get(Pixel % 61, Pixel / 61, Number) / 15.0, 1e-6) << Pixel;
		}
	}
}

TEST_F(FLightMaskRenderTest, PathsAgree)
{
	ASSERT_NO_FATAL_FAILURE(LoadBars());
	SetVariable("r.RT.Lights.Denoise", "1");
	AddLamps(8);
	AddLamps(6, 0.2f);
	for (const char* const Rate : {"0", "1"})
	{
		SetVariable("r.RT.Lights.Rate", Rate);
		std::vector<FMaskPicture> Last;
		for (const char* const Path : {"1", "2"})
		{
			SetVariable("r.RT.Shadow.Path", Path);
			GetEngine().SetFrameIndex(0);
			FView View = LookAtFloor(64, 36);
			FMaskPicture Picture;
			for (int Frame = 0; Frame < 4; ++Frame)
			{
				View.bCut = Frame == 0;
				Picture = RenderMask(View);
			}
			Last.push_back(Picture);
		}
		EXPECT_GT(MeanGreen(Last[0].Diffuse), 0.0);
		EXPECT_EQ(Last[0].Visibility, Last[1].Visibility) << Rate;
		EXPECT_EQ(Last[0].Lights, Last[1].Lights) << Rate;
		EXPECT_EQ(Last[0].Diffuse.Pixels, Last[1].Diffuse.Pixels) << Rate;
	}
}

// Nobody reads the rest: no pixel chooses, and the mask is the same.
TEST_F(FLightMaskRenderTest, AloneAsBesideTheRest)
{
	ASSERT_NO_FATAL_FAILURE(LoadBars());
	AddLamps(12);
	FView View = LookAtFloor(64, 36);
	View.bCut = true;
	const FMaskPicture Beside = RenderMask(View);
	GetEngine().Signals.bNothingElse = true;
	const FMaskPicture Alone = RenderMask(View);
	ASSERT_FALSE(Alone.Visibility.empty());
	EXPECT_EQ(Alone.Visibility, Beside.Visibility);
	EXPECT_EQ(Alone.Lights, Beside.Lights);
}

TEST_F(FLightMaskRenderTest, OddSizes)
{
	ASSERT_NO_FATAL_FAILURE(LoadBars());
	SetVariable("r.RT.Lights.Denoise", "1");
	FSceneLight Light;
	Light.Type = LIGHT_DIRECTIONAL;
	Light.Color = glm::vec3(2);
	Light.Size = {0.01f, 0};
	for (const uint32_t Count : {3u, 7u, 9u})
	{
		std::vector<FLightId> Ids;
		for (uint32_t I = 0; I < Count; ++I) { Ids.push_back(GetWorld().AddLight(Light)); }
		for (const auto& [X, Y] : {std::pair{1u, 1u}, {7u, 3u}, {9u, 1u}, {1u, 17u}, {131u, 73u}})
		{
			// A bare part of the floor: each pixel has all of the light.
			const FView View = LookAt({-6, 2, 0}, {-6, 0, 0.01}, 0.2f, X, Y);
			FMaskPicture Picture;
			for (int Frame = 0; Frame < 2; ++Frame) { Picture = RenderMask(View); } // sizes of two frames differ, too
			ASSERT_EQ(Picture.LightsWidth, (X + 7) / 8 * 8);
			ASSERT_EQ(Picture.LightsHeight, (Y + 7) / 8);
			for (uint32_t Pixel = 0; Pixel < X * Y; ++Pixel)
			{
				uint32_t Seen = 0;
				for (const FLightId Id : Ids) { Seen += Picture.Get(Pixel % X, Pixel / X, MakeLightNumber(Id)); }
				ASSERT_EQ(Seen, 15 * std::min(Count, Lamps8)) << X << " x " << Y;
				const double Rest = double(Count - std::min(Count, Lamps8));
				ASSERT_NEAR(Picture.Diffuse.Pixels[size_t(Pixel) * Picture.Diffuse.Channels], 2.0 * Rest / 3.14159265, 0.01);
			}
		}
		for (const FLightId Id : Ids) { GetWorld().RemoveLight(Id); }
	}
}

} // namespace
} // namespace Lantern
