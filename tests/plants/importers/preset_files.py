"""Small presets of the tests' own, in the shapes that PEERS part 4 describes."""

ARBARO = """<?xml version='1.0' ?>
<!-- a made-up tree -->
<arbaro>
  <species name='made_up birch'>
    <param name='Shape' value='2'/>
    <param name='Levels' value='3'/>
    <param name='Scale' value='9.5'/>
    <param name='ScaleV' value='1.5'/>
    <param name="BaseSize" value="0.25"/>
    <param name='Ratio' value='0.016'/>
    <param name='RatioPower' value='0'/>
    <param name='Flare' value='-0.8'/>
    <param name='LeafShape' value='disc7'/>
    <param name='Leaves' value='-12'/>
    <param name='LeafScale' value='0.002'/>
    <param name='LeafStemLen' value='-0.4'/>
    <param name='LeafDistrib' value='4'/>
    <param name='AttractionUp' value='10'/>
    <param name='Smooth' value='0.5'/>
    <param name='0Scale' value='1.2'/>
    <param name='0Length' value='1.0'/>
    <param name='0Taper' value='2.1'/>
    <param name='0CurveV' value='-25'/>
    <param name='0CurveRes' value='10'/>
    <param name='0BaseSplits' value='1'/>
    <param name='1Branches' value='12'/>
    <param name='1Length' value='0.4'/>
    <param name='1DownAngle' value='55'/>
    <param name='1DownAngleV' value='-30'/>
    <param name='1CurveV' value='480'/>
    <param name='1nBranchDist' value='1'/>
    <param name='2Branches' value='6'/>
    <param name='2Length' value='0.5'/>
  </species>
</arbaro>
"""
ARBARO_GRASS = """<arbaro><species name="tuft">
<param name="Levels" value="2"/><param name="Scale" value="0.5"/><param name="Ratio" value="0.004"/>
<param name="0Branches" value="49"/><param name="0DownAngle" value="10"/><param name="0DownAngleV" value="20"/>
<param name="0Length" value="1"/><param name="1Length" value="0"/><param name="0CurveRes" value="6"/>
<param name="Leaves" value="0"/>
</species></arbaro>
"""
ARBARO_LIST = """# made up
species = plain_tree
Shape = 4
Levels = 2
Scale = 6.0
0Length = 1
1Branches = 15
1Length = 0.3
Leaves = 8
LeafScale = 0.1
"""
TREE_GEN = """params = {
    'shape': 7,
    'g_scale': 11,
    'g_scale_v': 2,
    'levels': 3,
    'ratio': 0.015,
    'ratio_power': 1.1,
    'flare': 0.4,
    'base_size': [0.3, 0.02, 0.02, 0.02],
    'base_splits': -0,
    'down_angle': [-0, 60, 45, 45],
    'down_angle_v': [-0, -40, 10, 10],
    'rotate': [0, 140, 140, 77],
    'branches': [1, 30, 10, 1],
    'length': [1, 0.3, 0.5, 0],
    'curve_res': [4, 4, 2, 1],
    'curve_v': [20, 50, 75, 0],
    'bend_v': [0, 50, 0, 0],
    'leaf_blos_num': 12,
    'leaf_shape': 3,
    'leaf_scale': 0.17,
    'tropism': [0, 0.1, 0.5],
    'blossom_rate': 0,
    'colour': 'green',
}
"""
SAPLING = """# Sapling preset
{'shape': '7', 'handleType': '0', 'levels': 3, 'scale': 8.5, 'scaleV': 1.0, 'scale0': 1.0, 'scaleV0': 0.1,
 'length': [1.0, 0.30000001192092896, 0.6000000238418579, 0.45], 'lengthV': [0.0, 0.1, 0.0, 0.0],
 'branches': [0, 25, 8, 4], 'downAngle': [90.0, 60.0, 45.0, 45.0], 'downAngleV': [0.0, -50.0, 10.0, 10.0],
 'rotate': [99.5, 137.5, -60.0, 140.0], 'rotateV': [15.0, 0.0, 45.0, 0.0], 'curveRes': [8, 5, 3, 1],
 'curve': [0.0, -40.0, -40.0, 0.0], 'curveBack': [0.0, 0.0, 0.0, 0.0], 'curveV': [20.0, 50.0, 75.0, 0.0],
 'segSplits': [0.0, 0.0, 0.0, 0.0], 'splitAngle': [0.0, 0.0, 0.0, 0.0], 'splitAngleV': [0.0, 0.0, 0.0, 0.0],
 'baseSplits': 0, 'baseSize': 0.4000000059604645, 'ratio': 0.014999999664723873, 'ratioPower': 1.2,
 'rootFlare': 1.25, 'taper': [1.0, 1.0, 1.0, 1.0], 'attractUp': [0.0, 0.0, 0.5, 0.5], 'leaves': 15,
 'leafDownAngle': 45.0, 'leafDownAngleV': 10.0, 'leafRotate': 137.5, 'leafRotateV': 0.0,
 'leafScale': 0.17000000178813934, 'leafScaleX': 1.0, 'leafShape': 'hex', 'bend': 0.0, 'prune': False,
 'pruneRatio': 1.0, 'pruneWidth': 0.4, 'pruneWidthPeak': 0.6, 'prunePowerHigh': 0.5, 'prunePowerLow': 0.001,
 'wind': 1.0, 'gust': 1.0, 'gustF': 0.075, 'af1': 1.0, 'armAnim': False, 'boneStep': (1, 1, 1, 1), 'seed': 0,
 'bevel': True, 'showLeaves': True, 'rMode': 'rotate'}
"""
EZ_TREE = """{"seed": 29919, "type": "deciduous",
 "bark": {"type": "oak", "tint": 13552830, "flatShading": false, "textured": true},
 "branch": {"levels": 2, "angle": {"1": 48, "2": 75, "3": 60}, "children": {"0": 7, "1": 4, "2": 3},
  "force": {"direction": {"x": 0, "y": 1, "z": 0}, "strength": 0.01},
  "gnarliness": {"0": 0.03, "1": 0.25, "2": 0.2, "3": 0.09}, "length": {"0": 14, "1": 9, "2": 5, "3": 1},
  "radius": {"0": 0.6, "1": 0.53, "2": 0.79, "3": 1.11}, "sections": {"0": 8, "1": 6, "2": 4, "3": 3},
  "segments": {"0": 8, "1": 6, "2": 4, "3": 3}, "start": {"1": 0.4, "2": 0.2, "3": 0.1},
  "taper": {"0": 0.7, "1": 0.6, "2": 0.7, "3": 0.7}, "twist": {"0": 0, "1": 0, "2": 0, "3": 0}},
 "leaves": {"type": "oak", "billboard": "double", "angle": 55, "count": 10, "start": 0, "size": 0.9,
  "sizeVariance": 0.7, "tint": 16777215, "alphaTest": 0.5}}
"""
HELIOS = """<?xml version=1.0?>
<helios>
  <WeberPennTree label="">
    <Levels> 3 </Levels>
  </WeberPennTree>
  <WeberPennTree label="made up almond">
    <Shape> 1 </Shape>
    <Levels> 3 </Levels>
    <Scale> 3.5 </Scale>
    <ScaleV> 0.5 </ScaleV>
    <BaseSize> 0.3 </BaseSize>
    <nBaseSplits> 2 0 0 0 </nBaseSplits>
    <Ratio> 0.02 </Ratio>
    <RatioPower> 1.3 </RatioPower>
    <nLength> 1.0 0.5 0.4 0.0 </nLength>
    <nBranches> 1 12 8 0 </nBranches>
    <nDownAngle> 0 50 45 45 </nDownAngle>
    <nCurveRes> 6 4 3 1 </nCurveRes>
    <Leaves> 8 </Leaves>
    <LeafScale> 0.08 </LeafScale>
    <LeafAngle> 40 </LeafAngle>
    <LeafFile> leaf.png </LeafFile>
    <WoodTexture> wood.jpg </WoodTexture>
  </WeberPennTree>
  <WeberPennTree label="another"><Scale> 4 </Scale></WeberPennTree>
</helios>
"""
PRESETS = {
    "birch.xml": ARBARO,
    "tuft.xml": ARBARO_GRASS,
    "plain.txt": ARBARO_LIST,
    "ash.py": TREE_GEN,
    "aspen.py": SAPLING,
    "oak.json": EZ_TREE,
    "almond.xml": HELIOS,
}
