// Uploads a scene description and animates it: geometry, materials, lights, objects.
#include "LanternHost/HostScene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "HostMaterials.h"
#include "LanternCore/Text/Log.h"
#include "SkinningTypes.h"

namespace Lantern
{

FRTStatus FHostScene::Create(
    FRenderer& Renderer, FSceneDescription InDescription, const std::function<void(float)>& Progress, std::unique_ptr<FHostScene>& Out)
{
	std::unique_ptr<FHostScene> Host(new FHostScene(Renderer.GetDevice()));
	Host->Description = std::move(InDescription);
	Host->ContentHash = HashScene(Host->Description);
	Host->Pose = EvaluatePose(Host->Description, 0.0);
	Host->Opacity = ClassifySceneOpacity(Host->Description, Host->Pose);
	FUploader Uploader(Renderer.GetDevice());
	if (FRTStatus S = Host->UploadTextures(Uploader, Progress); !S) { return S; }
	if (FRTStatus S = Host->AddMaterials(Renderer.GetPrograms()); !S) { return S; }
	if (FRTStatus S = Host->UploadMeshes(Uploader); !S) { return S; }
	if (FRTStatus S = Host->CreateObjects(Uploader); !S) { return S; }
	if (FRTStatus S = Uploader.Flush(); !S) { return S; }
	for (const FProfileGrid& Grid : Host->Description.Profiles) { Host->Profiles.push_back(Host->Scene.AddLightProfile(Grid)); }
	Host->UpdateLights();
	if (Progress) { Progress(1.0f); }
	Out = std::move(Host);
	return FRTStatus::Success();
}

FRTStatus FHostScene::UploadMeshes(FUploader& Uploader)
{
	Meshes.resize(Description.Meshes.size());
	for (uint32_t Mesh = 0; Mesh < Meshes.size(); ++Mesh)
	{
		if (Description.Meshes[Mesh].Sections.empty()) { continue; }
		if (FRTStatus S = UploadMesh(Uploader, Mesh); !S) { return S; }
	}
	return FRTStatus::Success();
}

FRTStatus FHostScene::UploadMesh(FUploader& Uploader, uint32_t Mesh)
{
	const FHostMesh& Source = Description.Meshes[Mesh];
	FMeshBuffers& Buffers = Meshes[Mesh];
	const auto Upload = [&](const auto& Values, ERTBufferUsage Usage, TRTRef<IRTBuffer>& Buffer) {
		return Uploader.CreateBuffer(Source.Name.c_str(), Usage | ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput, Values.data(),
		    Values.size() * sizeof(Values[0]), Buffer);
	};
	if (FRTStatus S = Upload(Source.Positions, ERTBufferUsage::None, Buffers.Positions); !S) { return S; }
	if (FRTStatus S = Upload(Source.Attributes, ERTBufferUsage::None, Buffers.Attributes); !S) { return S; }
	if (FRTStatus S = Upload(Source.Indices, ERTBufferUsage::Index, Buffers.Indices); !S) { return S; }
	FOpacityPieceList& Pieces = Opacity.Meshes[Mesh].Pieces;
	if (Pieces.GetCount() > 0)
	{
		if (FRTStatus S = Upload(Pieces.Positions, ERTBufferUsage::None, Buffers.PiecePositions); !S) { return S; }
		if (FRTStatus S = Upload(Pieces.Indices, ERTBufferUsage::None, Buffers.PieceIndices); !S) { return S; }
		Pieces = {};
	}
	if (Source.Skin.empty()) { return Scene.CreateGeometry(MakeGeometryInfo(Mesh), Buffers.Geometry); }
	std::vector<FSkinVertex> Weights;
	for (const FSkinWeights& Skin : Source.Skin)
	{
		FSkinVertex Vertex{};
		Vertex.Joints01 = Skin.Joints[0] | (uint32_t(Skin.Joints[1]) << 16);
		Vertex.Joints23 = Skin.Joints[2] | (uint32_t(Skin.Joints[3]) << 16);
		Vertex.Weights = glm::vec4(Skin.Weights[0], Skin.Weights[1], Skin.Weights[2], Skin.Weights[3]);
		Weights.push_back(Vertex);
	}
	return Upload(Weights, ERTBufferUsage::None, Buffers.Weights);
}

FRTGeometryInfo FHostScene::MakeGeometryInfo(uint32_t Mesh) const
{
	const FHostMesh& Source = Description.Meshes[Mesh];
	FRTGeometryInfo Info;
	Info.Name = Source.Name;
	Info.Positions = Meshes[Mesh].Positions;
	Info.Attributes = Meshes[Mesh].Attributes;
	Info.Indices = Meshes[Mesh].Indices;
	Info.VertexCount = static_cast<uint32_t>(Source.Positions.size());
	Info.bHasTangents = Source.bHasTangents;
	Info.bOpaqueVertices =
	    std::all_of(Source.Attributes.begin(), Source.Attributes.end(), [](const FVertexAttributes& V) { return V.Color >= 0xff000000u; });
	Info.Sections = Opacity.Meshes[Mesh].Sections;
	for (size_t Section = 0; Section < Info.Sections.size(); ++Section)
	{
		const auto Material = static_cast<uint32_t>(Source.Sections[Section].Material);
		Info.Sections[Section].OpacityKey = MakeOpacityKey(Scene.GetMaterials()[Material]);
	}
	Info.PiecePositions = Meshes[Mesh].PiecePositions;
	Info.PieceIndices = Meshes[Mesh].PieceIndices;
	Info.CpuPositions = Source.Positions.data();
	Info.CpuIndices = Source.Indices.data();
	return Info;
}

FRTStatus FHostScene::CreateSkinnedGeometry(FUploader& Uploader, uint32_t Mesh, FRTGeometryRef& Out)
{
	const FHostMesh& Source = Description.Meshes[Mesh];
	FRTGeometryInfo Info = MakeGeometryInfo(Mesh);
	Info.bDynamic = true;
	constexpr ERTBufferUsage Usage = ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput;
	// In the bind pose, which shows while the skinning shader is compiled.
	const auto Upload = [&](const auto& Values, TRTRef<IRTBuffer>& Buffer) {
		return Uploader.CreateBuffer(Info.Name.c_str(), Usage, Values.data(), Values.size() * sizeof(Values[0]), Buffer);
	};
	TRTRef<IRTBuffer> Positions, Attributes;
	if (FRTStatus S = Upload(Source.Positions, Positions); !S) { return S; }
	const FRTBufferDesc Previous{Positions->GetDesc().Size, Usage, ERTMemory::Device, Info.Name.c_str()};
	if (FRTStatus S = Device.CreateBuffer(Previous, Info.PreviousPositions.ReleaseAndGetAddress()); !S) { return S; }
	if (FRTStatus S = Upload(Source.Attributes, Attributes); !S) { return S; }
	Info.Positions = Positions;
	Info.Attributes = Attributes;
	return Scene.CreateGeometry(std::move(Info), Out);
}

/// By node: some animation moves it, or one of its parents.
static std::vector<bool> FindAnimatedNodes(const FSceneDescription& Scene)
{
	std::vector<bool> Out(Scene.Nodes.size(), false);
	for (const FHostAnimation& Animation : Scene.Animations)
	{
		for (const FHostChannel& Channel : Animation.Channels) { Out[static_cast<size_t>(Channel.Node)] = true; }
	}
	for (size_t Node = 0; Node < Out.size(); ++Node)
	{
		const int32_t Parent = Scene.Nodes[Node].Parent; // parents come first
		if (Parent >= 0 && Out[static_cast<size_t>(Parent)]) { Out[Node] = true; }
	}
	return Out;
}

FRTStatus FHostScene::CreateObjects(FUploader& Uploader)
{
	const std::vector<bool> IsNodeAnimated = FindAnimatedNodes(Description);
	for (uint32_t Node = 0; Node < Description.Nodes.size(); ++Node)
	{
		const int32_t Mesh = Description.Nodes[Node].Mesh;
		if (Mesh < 0 || Description.Meshes[Mesh].Sections.empty()) { continue; }
		FInstance Instance;
		Instance.Node = static_cast<int32_t>(Node);
		FRTObjectInfo Info;
		Info.Geometry = Meshes[Mesh].Geometry;
		if (!Description.Meshes[Mesh].Skin.empty())
		{
			if (FRTStatus S = CreateSkinnedGeometry(Uploader, static_cast<uint32_t>(Mesh), Instance.Skinned); !S) { return S; }
			Info.Geometry = Instance.Skinned;
		}
		const std::vector<int32_t>& Own = Description.Nodes[Node].Materials;
		for (size_t Section = 0; Section < Description.Meshes[Mesh].Sections.size(); ++Section)
		{
			Info.Materials.push_back(
			    static_cast<uint32_t>(Own.empty() ? Description.Meshes[Mesh].Sections[Section].Material : Own[Section]));
		}
		Info.Transform = Pose.World[Node];
		FRTObjectTraits Traits = Description.Nodes[Node].Traits;
		Traits.bMoves = Instance.Skinned || IsNodeAnimated[Node];
		Info.Mask = MakeObjectMask(Traits);
		Info.bCharacter = Traits.bCharacter;
		Info.Channels = Traits.Channels;
		if (const auto& Toon = Description.Nodes[Node].Toon) { Info.Toon = std::make_shared<const FToonStyle>(*Toon); }
		Instance.Object = Scene.AddObject(Info);
		AddDraw(Instance, Info);
		Instances.push_back(std::move(Instance));
	}
	BuildDrawBlocks();
	return FRTStatus::Success();
}

void FHostScene::AddDraw(const FInstance& Instance, const FRTObjectInfo& Info)
{
	FDraw Draw;
	Draw.Object = Instance.Object;
	Draw.BatchCount = static_cast<uint32_t>(Info.Materials.size());
	Draw.FirstBatch = FindBatches(static_cast<uint32_t>(Description.Nodes[Instance.Node].Mesh), Info.Materials, *Info.Geometry);
	Draws.push_back(Draw);
}

uint32_t FHostScene::FindBatches(uint32_t Mesh, const std::vector<uint32_t>& Materials, const FRTGeometry& Geometry)
{
	const auto [Entry, bNew] = BatchesOf.try_emplace({Mesh, Materials}, static_cast<uint32_t>(BatchIndices.size()));
	if (!bNew) { return Entry->second; }
	std::vector<uint32_t> List;
	for (uint32_t Section = 0; Section < Materials.size(); ++Section)
	{
		const FRTSectionInfo& Info = Geometry.GetInfo().Sections[Section];
		const FHostMaterial& Material = Description.Materials[Materials[Section]];
		const FDrawBatch Batch{Geometry.GetInfo().Indices.Get(), Info.FirstIndex, Info.IndexCount, Section, IsMasked(Material),
		    Material.bDoubleSided, IsBlended(Material), IsTransmissive(Material), Scene.GetMaterialProgram(Materials[Section])};
		std::vector<uint32_t>& OfMesh = BatchesOfMesh[Mesh];
		const auto Found = std::find_if(OfMesh.begin(), OfMesh.end(), [&](uint32_t Index) { return Batches[Index] == Batch; });
		if (Found != OfMesh.end())
		{
			List.push_back(*Found);
			continue;
		}
		List.push_back(static_cast<uint32_t>(Batches.size()));
		OfMesh.push_back(List.back());
		Batches.push_back(Batch);
		DrawKinds.insert({Batch.Program, Batch.bMasked, Batch.bDoubleSided, Batch.bBlended});
	}
	// Most sets of materials give equal batches. They share one list, which then stays in the CPU cache.
	const auto [First, bNewList] = BatchLists.try_emplace(List, static_cast<uint32_t>(BatchIndices.size()));
	if (bNewList) { BatchIndices.insert(BatchIndices.end(), List.begin(), List.end()); }
	Entry->second = First->second;
	return Entry->second;
}

FDrawSphere FHostScene::MakeDrawSphere(size_t Instance) const
{
	const glm::dmat4& Transform = Scene.GetObject(Draws[Instance].Object).Transform;
	const FHostMesh& Mesh = Description.Meshes[Description.Nodes[Instances[Instance].Node].Mesh];
	// The Frobenius norm bounds how much any direction is stretched.
	const double Scale2 =
	    glm::dot(Transform[0], Transform[0]) + glm::dot(Transform[1], Transform[1]) + glm::dot(Transform[2], Transform[2]);
	FDrawSphere Sphere;
	Sphere.Center = glm::dvec3(Transform * glm::dvec4(0.5f * (Mesh.BoundsMin + Mesh.BoundsMax), 1.0));
	Sphere.Radius = Instances[Instance].Skinned ? std::numeric_limits<double>::infinity()
	                                            : std::sqrt(Scale2) * 0.5 * double(glm::length(Mesh.BoundsMax - Mesh.BoundsMin));
	Sphere.bMirrored = glm::determinant(glm::dmat3(Transform)) < 0.0;
	return Sphere;
}

void FHostScene::BuildDrawBlocks()
{
	std::vector<FDrawBlocks::FItem> Items;
	std::vector<FDrawSphere> Spheres;
	for (size_t Instance = 0; Instance < Draws.size(); ++Instance)
	{
		const FDraw& Draw = Draws[Instance];
		Items.push_back({Draw.Object.Index, Draw.FirstBatch, Draw.BatchCount});
		Spheres.push_back(MakeDrawSphere(Instance));
	}
	DrawBlocks.Build(Items, Spheres);
	for (const FDraw& Draw : Draws)
	{
		for (uint32_t I = 0; I < Draw.BatchCount; ++I) { ++Batches[BatchIndices[Draw.FirstBatch + I]].Places; }
	}
	for (FDrawBatch& Batch : Batches)
	{
		Batch.FirstPlace = PlaceCount;
		PlaceCount += Batch.Places;
	}
}

void FHostScene::SetTransform(size_t Instance, const glm::dmat4& Transform)
{
	Scene.SetTransform(Instances[Instance].Object, Transform);
	DrawBlocks.Move(static_cast<uint32_t>(Instance), MakeDrawSphere(Instance));
}

FSkinningInputs FHostScene::MakeSkinning(size_t Instance, std::vector<glm::mat4> Joints) const
{
	const FMeshBuffers& Buffers = Meshes[Description.Nodes[Instances[Instance].Node].Mesh];
	FSkinningInputs Item;
	Item.Geometry = Instances[Instance].Skinned;
	Item.SourcePositions = Buffers.Positions->GetDeviceAddress();
	Item.SourceAttributes = Buffers.Attributes->GetDeviceAddress();
	Item.Weights = Buffers.Weights->GetDeviceAddress();
	Item.Joints = std::move(Joints);
	return Item;
}

std::vector<FSkinningInputs> FHostScene::SetTime(double Time)
{
	const bool bFirst = Pose.World.empty();
	Pose = EvaluatePose(Description, Time);
	std::vector<FSkinningInputs> Skinning;
	for (size_t Index = 0; Index < Instances.size(); ++Index)
	{
		const FInstance& Instance = Instances[Index];
		const glm::dmat4& World = Pose.World[Instance.Node];
		if (bFirst || World != Scene.GetObject(Instance.Object).Transform) { SetTransform(Index, World); }
		if (Instance.Skinned) { Skinning.push_back(MakeSkinning(Index, EvaluateJoints(Description, Pose, Instance.Node))); }
	}
	LightTime = Time;
	if (IsAnimated()) { UpdateLights(); }
	return Skinning;
}

bool FHostScene::IsAnimated() const
{
	return !Description.Animations.empty() || std::any_of(Description.Lights.begin(), Description.Lights.end(),
	                                              [](const FHostLight& Light) { return Light.FlickerHz > 0.0f; });
}

void FHostScene::SetSceneLights(bool bEnabled)
{
	bSceneLights = bEnabled;
	UpdateLights();
}

int32_t FHostScene::FindOwnSun() const
{
	for (size_t Node = 0; Node < Description.Nodes.size(); ++Node)
	{
		const int32_t Light = Description.Nodes[Node].Light;
		if (Light >= 0 && Description.Lights[Light].Type == LIGHT_DIRECTIONAL) { return static_cast<int32_t>(Node); }
	}
	return -1;
}

std::optional<FSunLight> FHostScene::GetOwnSun() const
{
	const int32_t Node = FindOwnSun();
	if (Node < 0) { return std::nullopt; }
	const FHostLight& Light = Description.Lights[Description.Nodes[Node].Light];
	FSunLight Sun;
	const glm::dvec3 Axis = -glm::dvec3(Pose.World[Node][2]);
	if (!(glm::length(Axis) > 0.0)) { return std::nullopt; } // scaled to nothing: it shines nowhere
	Sun.Direction = glm::normalize(Axis);
	Sun.Irradiance = std::max({Light.Color.x, Light.Color.y, Light.Color.z});
	Sun.Color = Sun.Irradiance > 0.0f ? Light.Color / Sun.Irradiance : glm::vec3(1);
	Sun.Channels = Light.Channels;
	Sun.AngularDiameter = Light.Size.x > 0.0f ? Light.Size.x : glm::radians(Description.DefaultSunDiameter);
	return Sun;
}

float FHostScene::NearPlane() const
{
	glm::dvec3 Min(-1), Max(1);
	GetSceneBounds(Description, Pose, Min, Max);
	// With reversed depth and no far plane, a near plane this close costs no precision.
	return static_cast<float>(std::clamp(0.0005 * glm::length(Max - Min), 1e-4, 0.05));
}

FView FHostScene::MakeDefaultView(uint32_t Width, uint32_t Height) const
{
	for (size_t Node = 0; Node < Description.Nodes.size(); ++Node)
	{
		const int32_t Camera = Description.Nodes[Node].Camera;
		if (Camera < 0) { continue; }
		const glm::dmat4& World = Pose.World[Node];
		if (!(std::abs(glm::determinant(glm::dmat3(World))) > 0.0)) { continue; } // scaled to nothing: it looks nowhere
		FView View = LookAt(glm::dvec3(World[3]), glm::dvec3(World[3] - World[2]), Description.Cameras[Camera].FovY, Width, Height);
		View.Up = glm::vec3(glm::normalize(glm::dvec3(World[1])));
		View.Near = NearPlane();
		return View;
	}
	glm::dvec3 Min(-1), Max(1);
	GetSceneBounds(Description, Pose, Min, Max);
	const double FovY = glm::radians(45.0), Aspect = double(Width) / Height;
	const double Radius = std::max(1e-3, 0.5 * glm::length(Max - Min));
	const double HalfAngle = std::atan(std::tan(0.5 * FovY) * std::min(1.0, Aspect));
	const glm::dvec3 Center = 0.5 * (Min + Max), Direction = glm::normalize(glm::dvec3(0.35, 0.35, 1.0));
	FView View = LookAt(Center + Direction * (0.85 * Radius / std::sin(HalfAngle)), Center, static_cast<float>(FovY), Width, Height);
	View.Near = NearPlane();
	return View;
}

/// Places the light of a node. glTF lights shine along −z of it; scales do not change them.
FSceneLight FHostScene::MakeLight(uint32_t Node) const
{
	const FHostLight& Source = Description.Lights[Description.Nodes[Node].Light];
	const glm::dmat4& World = Pose.World[Node];
	FSceneLight Light = Source;
	if (Light.Profile != 0) { Light.Profile = Profiles[Light.Profile - 1]; }
	Light.Position = glm::dvec3(World[3]);
	const glm::dvec3 Axis = -glm::dvec3(World[2]), Side(World[0]);
	// A node may be scaled to nothing along some of its axes.
	const glm::dvec3 Along = glm::length(Axis) > 0.0 ? glm::normalize(Axis) : glm::dvec3(0, -1, 0);
	const bool bFlat = !(glm::length(glm::cross(Along, Side)) > 0.0);
	const glm::dvec3 Across = glm::cross(Along, std::abs(Along.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
	Light.Direction = glm::vec3(Along);
	Light.Tangent = glm::vec3(glm::normalize(bFlat ? Across : Side));
	// A light that is off keeps its slot, since methods may remember lights by it.
	if (!IsLightOn(Source, LightTime)) { Light.Color = glm::vec3(0); }
	return Light;
}

void FHostScene::UpdateLights()
{
	const int32_t OwnSun = FindOwnSun();
	LightIds.resize(Description.Nodes.size());
	for (uint32_t Node = 0; Node < Description.Nodes.size(); ++Node)
	{
		if (Description.Nodes[Node].Light < 0) { continue; }
		FLightId& Id = LightIds[Node];
		if (!bSceneLights || static_cast<int32_t>(Node) == OwnSun)
		{
			if (Id.IsValid()) { Scene.RemoveLight(std::exchange(Id, {})); }
			continue;
		}
		const FSceneLight Light = MakeLight(Node);
		if (!Id.IsValid()) { Id = Scene.AddLight(Light); }
		else if (Scene.GetLights().Get(Id) != Light) { Scene.SetLight(Id, Light); }
	}
}

} // namespace Lantern
