// Sampling of animations, hierarchies and skins.
#include <glm/gtc/constants.hpp>

#include "Support/GltfTestTools.h"

namespace Lantern
{
namespace
{

FSceneDescription MakeAnimated(EAnimationPath Path, EInterpolation Interpolation, std::vector<float> Times, std::vector<glm::vec4> Values)
{
	FSceneDescription Scene;
	Scene.Nodes.resize(1);
	FHostAnimation Animation;
	Animation.Duration = Times.back();
	FHostChannel Channel;
	Channel.Node = 0;
	Channel.Path = Path;
	Channel.Interpolation = Interpolation;
	Channel.Times = std::move(Times);
	Channel.Values = std::move(Values);
	Animation.Channels.push_back(Channel);
	Scene.Animations.push_back(Animation);
	return Scene;
}

glm::dvec3 GetPlace(const FSceneDescription& Scene, double Time) { return glm::dvec3(EvaluatePose(Scene, Time).World[0][3]); }

TEST(SceneAnimation, StepHoldsAndLinearBlends)
{
	const std::vector<glm::vec4> Values = {{0, 0, 0, 0}, {4, 0, 0, 0}, {4, 8, 0, 0}};
	const auto Step = MakeAnimated(EAnimationPath::Translation, EInterpolation::Step, {1, 2, 4}, Values);
	EXPECT_EQ(GetPlace(Step, 0.5), glm::dvec3(0, 0, 0)); // before the first key
	EXPECT_EQ(GetPlace(Step, 1.99), glm::dvec3(0, 0, 0));
	EXPECT_EQ(GetPlace(Step, 2.0), glm::dvec3(4, 0, 0));
	const auto Linear = MakeAnimated(EAnimationPath::Translation, EInterpolation::Linear, {1, 2, 4}, Values);
	EXPECT_EQ(GetPlace(Linear, 1.25), glm::dvec3(1, 0, 0));
	EXPECT_EQ(GetPlace(Linear, 3.0), glm::dvec3(4, 4, 0));
}

TEST(SceneAnimation, TimeIsLooped)
{
	const auto Scene = MakeAnimated(EAnimationPath::Translation, EInterpolation::Linear, {0, 2}, {{0, 0, 0, 0}, {2, 0, 0, 0}});
	EXPECT_NEAR(GetPlace(Scene, 7.5).x, 1.5, 1e-9);
	EXPECT_NEAR(GetPlace(Scene, -0.5).x, 1.5, 1e-9);
	EXPECT_EQ(GetPlace(Scene, 2.0).x, 0.0);
}

TEST(SceneAnimation, RotationsTakeTheShortWayAtConstantSpeed)
{
	const float H = std::sqrt(0.5f);
	// A quarter turn about y; the second key is the negative of the same rotation.
	const auto Scene = MakeAnimated(EAnimationPath::Rotation, EInterpolation::Linear, {0, 3}, {{0, 0, 0, 1}, {0, -H, 0, -H}});
	const glm::dvec3 X = EvaluatePose(Scene, 1.0).World[0] * glm::dvec4(1, 0, 0, 0);
	EXPECT_NEAR(X.x, std::cos(glm::radians(30.0)), 1e-6);
	EXPECT_NEAR(X.z, -std::sin(glm::radians(30.0)), 1e-6);
}

TEST(SceneAnimation, CubicSplinesFollowTheirTangents)
{
	// x(t) = t³ from 0 to 2: its Hermite form has slopes 0 and 12.
	const auto Scene = MakeAnimated(EAnimationPath::Translation, EInterpolation::CubicSpline, {0, 2},
	    {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {12, 0, 0, 0}, {8, 0, 0, 0}, {0, 0, 0, 0}});
	for (const double Time : {0.0, 0.5, 1.0, 1.7}) { EXPECT_NEAR(GetPlace(Scene, Time).x, Time * Time * Time, 1e-6); }
}

TEST(SceneAnimation, ScaleAndRotationComposeInTheRightOrder)
{
	FSceneDescription Scene;
	Scene.Nodes.resize(2);
	Scene.Nodes[0].Translation = {10, 0, 0};
	Scene.Nodes[0].Rotation = glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 0, 1));
	Scene.Nodes[0].Scale = {2, 3, 4};
	Scene.Nodes[1].Parent = 0;
	Scene.Nodes[1].Translation = {1, 1, 1};
	const glm::dvec3 Place(EvaluatePose(Scene, 0).World[1][3]);
	EXPECT_LT(glm::length(Place - glm::dvec3(10 - 3, 2, 4)), 1e-5);
}

/// An arm of two bones along x; the second bends at x = 1.
FGltfMaker MakeArm()
{
	FGltfMaker Maker;
	auto& Primitive = Maker.AddTriangle();
	Primitive["attributes"]["POSITION"] = Maker.AddVec3({0, 0, 0, 1, 0, 0, 2, 0, 0});
	Primitive["attributes"]["NORMAL"] = Maker.AddVec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
	// Unused slots name joints that do not exist: they weigh nothing.
	Primitive["attributes"]["JOINTS_0"] = Maker.AddAccessor(std::vector<uint8_t>{0, 99, 0, 0, 0, 1, 0, 0, 1, 0, 99, 0}, "VEC4", 5121, 3);
	Primitive["attributes"]["WEIGHTS_0"] = Maker.AddAccessor(std::vector<float>{1, 0, 0, 0, 0.5, 0.5, 0, 0, 2, 0, 0, 0}, "VEC4", 5126, 3);
	const std::vector<float> Bind = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1};
	Maker.Json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", Maker.AddAccessor(Bind, "MAT4", 5126, 2)}}};
	// The skinned node's own place does not count.
	Maker.Json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {0, 50, 0}}}, {{"children", {2}}, {"translation", {0, 0, 7}}},
	    {{"translation", {1, 0, 0}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}};
	return Maker;
}

TEST(SceneAnimation, ASkinBendsItsMeshWhereverItsNodeIs)
{
	const FLoadResult Result = MakeArm().Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	const FSceneDescription& Scene = *Result.Scene;
	const FScenePose Pose = EvaluatePose(Scene, 0);
	int32_t Node = 0;
	while (Scene.Nodes[size_t(Node)].Skin < 0) { ++Node; }
	const std::vector<glm::mat4> Joints = EvaluateJoints(Scene, Pose, Node);
	ASSERT_EQ(Joints.size(), 2u);
	const glm::dvec4 Tip = Pose.World[size_t(Node)] * glm::dvec4(Joints[1] * glm::vec4(2, 0, 0, 1));
	EXPECT_LT(glm::length(glm::dvec3(Tip) - glm::dvec3(1, 1, 7)), 1e-5);
	const FSkinWeights& Weights = Scene.Meshes[0].Skin[2];
	EXPECT_EQ(Weights.Weights[0], 1.0f); // renormalised
	EXPECT_EQ(Weights.Joints, (std::array<uint16_t, 4>{1, 0, 0, 0}));
	glm::dvec3 Min, Max;
	ASSERT_TRUE(GetSceneBounds(Scene, Pose, Min, Max));
	EXPECT_LT(glm::length(Min - glm::dvec3(0, 0, 7)), 1e-5);
	EXPECT_LT(glm::length(Max - glm::dvec3(1, 1, 7)), 1e-5);
}

TEST(SceneAnimation, OfEightInfluencesTheStrongestFourStay)
{
	FGltfMaker Maker = MakeArm();
	auto& Attributes = Maker.Json["meshes"][0]["primitives"][0]["attributes"];
	Attributes["JOINTS_1"] = Maker.AddAccessor(std::vector<uint16_t>{0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}, "VEC4", 5123, 3);
	Attributes["WEIGHTS_1"] = Maker.AddAccessor(std::vector<float>(12, 0.25f), "VEC4", 5126, 3);
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	const FSkinWeights& Weights = Result.Scene->Meshes[0].Skin[0]; // 1 and four of 0.25
	EXPECT_NEAR(Weights.Weights[0], 1.0 / 1.75, 1e-6);
	EXPECT_NEAR(Weights.Weights[3], 0.25 / 1.75, 1e-6);
}

TEST(SceneAnimation, AJointThatDoesNotExistIsAnError)
{
	FGltfMaker Maker = MakeArm();
	Maker.Json["skins"][0]["joints"] = {1};
	ExpectError(Maker.Load(), {"joint 1", "skins[0]", "has 1"});
}

TEST(SceneAnimation, ChannelsAreReadFromAFile)
{
	FGltfMaker Maker;
	Maker.AddTriangle();
	const int Times = Maker.AddAccessor(std::vector<float>{0, 1}, "SCALAR", 5126, 2);
	Maker.Json["animations"] = {{{"samplers", {{{"input", Times}, {"output", Maker.AddVec3({0, 0, 0, 2, 0, 0})}}}},
	    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	EXPECT_EQ(GetPlace(*Result.Scene, 0.25).x, 0.5);
	Maker.Json["animations"][0]["samplers"][0]["output"] = Times;
	ExpectError(Maker.Load(), {"animations[0].samplers[0]", "output"});
}

TEST(RealScenes, BrainStemStandsAndMoves)
{
	const auto Path = GetScenesFolder() / "brainstem/BrainStem.glb";
	LANTERN_REQUIRE_SCENE(Path);
	const FLoadResult Result = LoadScene(Path.string());
	ASSERT_TRUE(Result.Scene) << Result.Error;
	const FSceneDescription& Scene = *Result.Scene;
	EXPECT_EQ(Scene.Materials.size(), 59u);
	EXPECT_EQ(Scene.Skins.size(), 1u);
	glm::dvec3 FirstMin, FirstMax;
	double Travel = 0.0;
	ASSERT_TRUE(GetSceneBounds(Scene, EvaluatePose(Scene, 0), FirstMin, FirstMax));
	for (double Time = 0; Time < double(Scene.Animations[0].Duration); Time += 1.0)
	{
		// A figure of a man's height with its feet on the ground, whatever it does with its arms.
		glm::dvec3 Min, Max;
		ASSERT_TRUE(GetSceneBounds(Scene, EvaluatePose(Scene, Time), Min, Max));
		EXPECT_GT(Min.y, -0.1) << "at " << Time;
		EXPECT_LT(Min.y, 0.25) << "at " << Time;
		EXPECT_GT(Max.y, 1.4);
		EXPECT_LT(Max.y, 2.4);
		EXPECT_LT(Max.x - Min.x, 2.5);
		Travel = std::max(Travel, glm::length(Min - FirstMin));
	}
	EXPECT_GT(Travel, 0.1);
}

} // namespace
} // namespace Lantern
