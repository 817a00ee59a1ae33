// Diffuse GI whose rays end in radiance cells, on small pictures: without a filter, and with a table that suits them.
#pragma once

#include <cmath>
#include <vector>

#include "SignalFixture.h"

namespace Lantern
{

class FCachedGITest : public FSignalTest
{
protected:
	static constexpr uint32_t WarmFrames = 48;

	/// Route: of r.RT.GI.
	void SetRoute(const char* Route)
	{
		SetVariable("r.RT.GI.Denoise", "0");
		SetVariable("r.RT.Reflections", "0");
		SetVariable("r.RT.GI", Route);
		// Pictures here have few pixels, so they need few cells.
		SetVariable("r.RT.GI.Cells.Capacity", "65536");
		SetVariable("r.RT.GI.Cells.SizeAngle", "0.1");
		SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "120000");
	}

	/// Mean of Count frames behind Warm ones of a table that begins empty.
	static FImage RenderSettled(const FView& View, uint32_t Count = 8, uint32_t Warm = WarmFrames)
	{
		RenderSignal(ESignal::DiffuseGI, View, Warm);
		return RenderSignal(ESignal::DiffuseGI, View, Count, Warm);
	}

	/// A floor before a glossy wall, which the sun grazes. bDirection: cells know from where their light comes, else they are wrong by a sixth.
	void LoadGlossyWall(bool bDirection)
	{
		FTestScene Scene("wall");
		FHostMaterial Glossy;
		Glossy.BaseColor = glm::vec4(0.1f, 0.1f, 0.1f, 1.0f);
		Glossy.Metallic = 0.0f;
		Glossy.Roughness = 0.6f;
		const int32_t Wall = Scene.AddMaterial(Glossy), Floor = Scene.AddLambert(glm::vec3(0.5f));
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Floor, 4.0f), {Wall, {{-4, 0, -2}, {4, 0, -2}, {4, 6, -2}, {-4, 6, -2}}}}));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.53, 10.0f, {0.1, -1, -0.4});
		SetVariable("r.RT.GI.Cells.Near", "0"); // rays to the wall's foot end in cells, too
		SetVariable("r.RT.Debug.GI.CellDirection", bDirection ? "1" : "0");
	}
	static FView LookAtGlossyWall() { return LookAt({0, 1.5, 3}, {0, 0, -0.5}, 0.5f, 48, 27); }

	/// Mean of each column.
	static std::vector<double> FindProfile(const FImage& Image)
	{
		std::vector<double> Profile;
		for (uint32_t X = 0; X < Image.Width; ++X)
		{
			double Sum = 0;
			for (uint32_t Y = 0; Y < Image.Height; ++Y) { Sum += double(Image.At(X, Y, 1)); }
			Profile.push_back(Sum / Image.Height);
		}
		return Profile;
	}

	/// Mean difference between the columns of two pictures, over the mean of the second.
	static double RelativeError(const FImage& Image, const FImage& Reference)
	{
		const std::vector<double> Ours = FindProfile(Image), Theirs = FindProfile(Reference);
		double Differences = 0, Sum = 0;
		for (size_t X = 0; X < Ours.size(); ++X)
		{
			Differences += std::abs(Ours[X] - Theirs[X]);
			Sum += Theirs[X];
		}
		return Differences / Sum;
	}

	/// Two runs from empty tables.
	void ExpectTheSameBitsAgain(const std::string& Scene, const FView& View)
	{
		FImage Pictures[2];
		for (FImage& Picture : Pictures)
		{
			ASSERT_TRUE(Load(Scene));
			Picture = RenderSettled(View, 4);
		}
		EXPECT_EQ(FractionDiffering(Pictures[0], Pictures[1], 0.0), 0.0);
	}
};

} // namespace Lantern
