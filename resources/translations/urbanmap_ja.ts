<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="ja" sourcelanguage="en">
<context>
    <name>UrbanMap</name>
    <message>
        <source>Seed</source>
        <translation>乱数シード</translation>
    </message>
    <message>
        <source>A whole number; every one gives another city.</source>
        <translation>整数です。値ごとに異なる都市になります。</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>大きさ</translation>
    </message>
    <message>
        <source>m</source>
        <translation>m</translation>
    </message>
    <message>
        <source>Side of the square city in metres, 60 to 600. Time and disk space grow with its square.</source>
        <translation>正方形の都市の一辺の長さ（m、60～600）です。処理時間とディスク使用量はその2乗で増えます。</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>シーン</translation>
    </message>
    <message>
        <source>street canyon</source>
        <translation>高層建物に挟まれた街路</translation>
    </message>
    <message>
        <source>few road markings</source>
        <translation>路面標示が少ない道路</translation>
    </message>
    <message>
        <source>repainted road markings</source>
        <translation>引き直された路面標示</translation>
    </message>
    <message>
        <source>elevated road</source>
        <translation>高架道路</translation>
    </message>
    <message>
        <source>A high-rise street canyon; one with few road markings; one whose markings were repainted between the flights and the drives; one under an elevated road. (canyon, few markings, repainted, elevated road)</source>
        <translation>高層ビル街（canyon）、路面標示の少ない都市（few markings）、撮影飛行と走行の間に路面標示が塗り直された都市（repainted）、高架道路の下の都市（elevated road）から選びます。（canyon, few markings, repainted, elevated road）</translation>
    </message>
    <message>
        <source>Faults</source>
        <translation>不適合</translation>
    </message>
    <message>
        <source>Faults of real surveys to put in, with commas between them: steps (in the trajectories), stops (a long wait), ghosts (points below the road), rings (lasers that differ), ground (heights of the airborne points that are off), rails (and decks), driveways (lowered kerbs), signs (boards and bollards), gantries (with boards over the streets), japan, germany, us (street furniture in the sizes of their standards), islands (in the avenue), paint (worn and patched), surface (wet and concrete stretches), fronts (canopies, signs, garden walls, hoardings, balconies, awnings and storeys on columns before buildings). Without any the city is as ever.</source>
        <translation>実際の計測に見られる不具合を、コンマ区切りで加えます：steps（軌跡の段差）、stops（長い停車）、ghosts（路面より下の点）、rings（特性の異なるレーザ）、ground（航空レーザ点の標高のずれ）、rails（レールと床版）、driveways（縁石の切下げ）、signs（標識板とボラード）、gantries（道路上の標識板付き門型柱）、japan・germany・us（各国の基準の寸法による道路付属物）、islands（大通りの島）、paint（摩耗や補修のある標示）、surface（濡れた区間とコンクリート区間）、fronts（建物の前の庇、看板、塀、仮囲い、バルコニー、日よけ、ピロティ）。指定しなければ通常の都市です。</translation>
    </message>
    <message>
        <source>Workers</source>
        <translation>並列数</translation>
    </message>
    <message>
        <source>Number of sensors that measure at the same time. The result does not depend on it.</source>
        <translation>同時に計測するセンサの数です。結果には影響しません。</translation>
    </message>
    <message>
        <source>Sample city</source>
        <translation>サンプル都市</translation>
    </message>
    <message>
        <source>A new or empty folder.</source>
        <translation>新規または空のフォルダを指定します。</translation>
    </message>
    <message>
        <source>ALS points, unclassified</source>
        <translation>航空レーザ点群（未分類）</translation>
    </message>
    <message>
        <source>ALS points, classified</source>
        <translation>航空レーザ点群（分類済み）</translation>
    </message>
    <message>
        <source>Official outlines</source>
        <translation>公的な建物外周線</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>カメラ</translation>
    </message>
    <message>
        <source>Exterior orientation</source>
        <translation>外部標定要素</translation>
    </message>
    <message>
        <source>Conventional orthophoto</source>
        <translation>従来のオルソ画像</translation>
    </message>
    <message>
        <source>Mobile survey 1</source>
        <translation>MMS計測1</translation>
    </message>
    <message>
        <source>Trajectory of survey 1, as reported</source>
        <translation>MMS計測1の軌跡（補正前）</translation>
    </message>
    <message>
        <source>Mobile survey 2</source>
        <translation>MMS計測2</translation>
    </message>
    <message>
        <source>Trajectory of survey 2, as reported</source>
        <translation>MMS計測2の軌跡（補正前）</translation>
    </message>
    <message>
        <source>Calibration of the mobile survey</source>
        <translation>MMS計測の校正値</translation>
    </message>
    <message>
        <source>Aerial frames</source>
        <translation>空中写真</translation>
    </message>
    <message>
        <source>GNSS observations</source>
        <translation>GNSS観測データ</translation>
    </message>
    <message>
        <source>Line scans and line images</source>
        <translation>ライン測距データとライン画像</translation>
    </message>
    <message>
        <source>Truth</source>
        <translation>真値</translation>
    </message>
    <message>
        <source>Number of buildings.</source>
        <translation>建物の数です。</translation>
    </message>
    <message>
        <source>Buildings</source>
        <translation>建物</translation>
    </message>
    <message>
        <source>Number of airborne laser points.</source>
        <translation>航空レーザ点の数です。</translation>
    </message>
    <message>
        <source>ALS points</source>
        <translation>航空レーザ点</translation>
    </message>
    <message>
        <source>Number of points of both mobile surveys.</source>
        <translation>2つのMMS計測の点の合計数です。</translation>
    </message>
    <message>
        <source>MMS points</source>
        <translation>MMS点</translation>
    </message>
    <message>
        <source>Point clouds</source>
        <translation>点群</translation>
    </message>
    <message>
        <source>One or several LAS, LAZ or COPC files in one projected coordinate system, heights in metres.</source>
        <translation>同じ投影座標系の1つまたは複数のLAS、LAZまたはCOPCファイルです。標高の単位はmです。</translation>
    </message>
    <message>
        <source>Point clouds (*.las *.laz *.LAS *.LAZ)</source>
        <translation>点群 (*.las *.laz *.LAS *.LAZ)</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>すべてのファイル (*)</translation>
    </message>
    <message>
        <source>Control points (*.csv *.txt)</source>
        <translation>調整点 (*.csv *.txt)</translation>
    </message>
    <message>
        <source>Control points</source>
        <translation>基準点（調整点・検証点）</translation>
    </message>
    <message>
        <source>CSV file id,x,y,z in the cloud's coordinate system and heights; x_als,y_als,z_als where the point lies in the cloud, if it was found there; role: control or check.</source>
        <translation>CSV ファイル id,x,y,z（点群と同じ座標系と高さ）。点群の中で見つけた点は、その位置を x_als,y_als,z_als に書きます。role には control（調整点）または check（検証点）を書きます。</translation>
    </message>
    <message>
        <source>Accuracy of the control points</source>
        <translation>標定点の精度</translation>
    </message>
    <message>
        <source>Standard deviation of their coordinates and of their places in the cloud, in metres.</source>
        <translation>調整点の座標と、点群中で測った位置の標準偏差（m）。</translation>
    </message>
    <message>
        <source>CRS of the point clouds</source>
        <translation>点群の座標参照系</translation>
    </message>
    <message>
        <source>Projected coordinate system in metres of files that state none or a wrong one; it counts before what they state.</source>
        <translation>座標系を記していない、または誤って記しているファイルの投影座標系（メートル）。ファイルの記載より優先されます。</translation>
    </message>
    <message>
        <source>Shifted points</source>
        <translation>移動した点群</translation>
    </message>
    <message>
        <source>LAZ point cloud (*.laz);;LAS point cloud (*.las)</source>
        <translation>LAZ点群 (*.laz);;LAS点群 (*.las)</translation>
    </message>
    <message>
        <source>All points in their order, with all attributes.</source>
        <translation>すべての点を元の順序で、すべての属性とともに出力します。</translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>Control and check points with the cloud's errors, as given, after, and left out.</source>
        <translation>調整点と検証点における点群の誤差（補正前、補正後、その点を除外した場合）。</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>報告書</translation>
    </message>
    <message>
        <source>HTML report (*.html)</source>
        <translation>HTML報告書 (*.html)</translation>
    </message>
    <message>
        <source>The shift, its accuracy, and errors at the points.</source>
        <translation>移動量とその精度、各点の誤差。</translation>
    </message>
    <message>
        <source>By how much the cloud was shifted.</source>
        <translation>点群を移動した量。</translation>
    </message>
    <message>
        <source>Shift east</source>
        <translation>東方向の移動量</translation>
    </message>
    <message>
        <source>Shift north</source>
        <translation>北方向の移動量</translation>
    </message>
    <message>
        <source>Shift up</source>
        <translation>高さ方向の移動量</translation>
    </message>
    <message>
        <source>RMS error in height of the control points that are followed, as given.</source>
        <translation>採用した調整点における、補正前の高さの誤差の RMS。</translation>
    </message>
    <message>
        <source>RMS before</source>
        <translation>補正前のRMS</translation>
    </message>
    <message>
        <source>The same after the adjustment.</source>
        <translation>調整後の同じ値。</translation>
    </message>
    <message>
        <source>RMS after</source>
        <translation>補正後のRMS</translation>
    </message>
    <message>
        <source>The same, each point left out in turn.</source>
        <translation>点を1つずつ除いた場合の同じ値。</translation>
    </message>
    <message>
        <source>RMS left out</source>
        <translation>除いた点の RMS</translation>
    </message>
    <message>
        <source>RMS error of the check points in height, after.</source>
        <translation>検証点における、補正後の高さの誤差の RMS。</translation>
    </message>
    <message>
        <source>RMS of check points</source>
        <translation>検証点の RMS</translation>
    </message>
    <message>
        <source>Control points that contradict the others.</source>
        <translation>ほかの点と矛盾する標定点の数。</translation>
    </message>
    <message>
        <source>Contradicting points</source>
        <translation>矛盾する点</translation>
    </message>
    <message>
        <source>Adjust laser points to control points</source>
        <translation>航空レーザ点群を調整点に合わせる</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>写真</translation>
    </message>
    <message>
        <source>8 or 16 bit TIFF or JPEG images as the camera took them, each named in the exterior orientation.</source>
        <translation>撮影されたままの8または16ビットのTIFFまたはJPEG画像です。それぞれの名称が外部標定要素にある必要があります。</translation>
    </message>
    <message>
        <source>Images (*.tif *.tiff *.jpg *.jpeg *.png *.TIF *.TIFF *.JPG *.JPEG *.PNG)</source>
        <translation>画像 (*.tif *.tiff *.jpg *.jpeg *.png *.TIF *.TIFF *.JPG *.JPEG *.PNG)</translation>
    </message>
    <message>
        <source>Camera (*.json)</source>
        <translation>カメラ (*.json)</translation>
    </message>
    <message>
        <source>JSON file of the camera: focal_length_mm, pixel_pitch_mm, image_width, image_height, principal_point_mm, distortion.</source>
        <translation>カメラのJSONファイルです：focal_length_mm, pixel_pitch_mm, image_width, image_height, principal_point_mm, distortion。</translation>
    </message>
    <message>
        <source>Exterior orientation (*.csv *.txt)</source>
        <translation>外部標定要素 (*.csv *.txt)</translation>
    </message>
    <message>
        <source>CSV file image,x,y,z,omega,phi,kappa (metres, degrees), or what Metashape (Omega Phi Kappa) or Pix4D wrote, whose order of angles is known.</source>
        <translation>CSV ファイル image,x,y,z,omega,phi,kappa（メートル、度）、または Metashape（Omega Phi Kappa）か Pix4D が出力したファイル（角の順序は自動で判別）。</translation>
    </message>
    <message>
        <source>Ground</source>
        <translation>地表</translation>
    </message>
    <message>
        <source>Heights of the bare ground in metres; the mosaic has its coordinate system.</source>
        <translation>地表の標高（m）です。モザイクの座標系はこれと同じになります。</translation>
    </message>
    <message>
        <source>Surface</source>
        <translation>表層</translation>
    </message>
    <message>
        <source>Heights of the surface (DSM) in metres, with which hidden ground is told.</source>
        <translation>表層（DSM）の標高（m）です。隠れた地表の判定に使います。</translation>
    </message>
    <message>
        <source>Building outlines</source>
        <translation>建物外周線</translation>
    </message>
    <message>
        <source>Ground inside them is masked too.</source>
        <translation>その内側の地表もマスクします。</translation>
    </message>
    <message>
        <source>Field with the buildings' height</source>
        <translation>建物の高さのフィールド</translation>
    </message>
    <message>
        <source>Field of the outlines with the height above the ground in metres. Such buildings also hide what lies behind them, where the surface lacks them; without it only what the surface shows hides anything.</source>
        <translation>外周線のフィールドのうち、地表からの高さ（m）を持つものです。表層に建物が欠けていても、その建物の背後は隠れるものとします。指定しない場合、隠すのは表層にある物だけです。</translation>
    </message>
    <message>
        <source>Resolution</source>
        <translation>解像度</translation>
    </message>
    <message>
        <source>Side of a pixel in metres; 0 for that of the frames.</source>
        <translation>画素の一辺（m）です。0の場合は写真の地上画素寸法とします。</translation>
    </message>
    <message>
        <source>Filter vehicles</source>
        <translation>車両の除去</translation>
    </message>
    <message>
        <source>Take each pixel so that moving vehicles go; otherwise from the frame that looks down most steeply.</source>
        <translation>走行車両が消えるように各画素を選びます。無効の場合は、最も真下に近い向きで見る写真から選びます。</translation>
    </message>
    <message>
        <source>Vehicle filter</source>
        <translation>車両の除去</translation>
    </message>
    <message>
        <source>majority vote</source>
        <translation>多数決</translation>
    </message>
    <message>
        <source>darkest image</source>
        <translation>最も暗い画像</translation>
    </message>
    <message>
        <source>as in the paper</source>
        <translation>論文どおり</translation>
    </message>
    <message>
        <source>Majority vote: what most frames agree on, which also keeps dark vehicles from winning over paint. Darkest: the frame with the lowest sum of channels. Paper: as in the paper, darkest without gain compensation, of frames masked by their plain occlusion maps. (vote, darkest, paper)</source>
        <translation>vote：多数決で、大半の写真が一致する値をとります。暗い車両が標示より優先されることも防ぎます。darkest：チャンネルの和が最小の写真をとります。paper：論文どおり、単純な遮蔽図でマスクした写真から、輝度補正なしで最も暗いものをとります。（vote, darkest, paper）</translation>
    </message>
    <message>
        <source>Gain compensation</source>
        <translation>輝度補正</translation>
    </message>
    <message>
        <source>Bring all frames to one brightness and contrast before they are compared.</source>
        <translation>比較の前に、すべての写真の明るさとコントラストをそろえます。</translation>
    </message>
    <message>
        <source>Hidden ground</source>
        <translation>隠れた地表</translation>
    </message>
    <message>
        <source>lines of sight from the ground</source>
        <translation>地表からの視線</translation>
    </message>
    <message>
        <source>occlusion map of each frame</source>
        <translation>写真ごとの遮蔽図</translation>
    </message>
    <message>
        <source>Ground: told by lines of sight from the ground to the frame. Frame: told by an occlusion map of each frame, which masks it before ground is taken from it, as in the paper. (ground, frame)</source>
        <translation>ground：地表から写真への視線で判定します。frame：論文どおり、各写真の遮蔽図で写真をマスクしてから地表を取り出します。（ground, frame）</translation>
    </message>
    <message>
        <source>Occlusion maps</source>
        <translation>遮蔽図</translation>
    </message>
    <message>
        <source>Occlusion maps of the frames, from “Occlusion map of a frame”, one for each frame in the frames' order; they are then taken instead of being made.</source>
        <translation>「写真の遮蔽図」による各写真の遮蔽図です。写真と同じ順に1枚ずつ指定します。指定すると、新たに作成せずこれらを使います。</translation>
    </message>
    <message>
        <source>Height threshold</source>
        <translation>高さのしきい値</translation>
    </message>
    <message>
        <source>What stands higher than this above the ground, in metres, hides ground; vehicles should not.</source>
        <translation>地表からこの高さ（m）を超える物が地表を隠します。車両は含めないようにしてください。</translation>
    </message>
    <message>
        <source>Order of the angles</source>
        <translation>角度の順序</translation>
    </message>
    <message>
        <source>R_omega R_phi R_kappa, as in the papers</source>
        <translation>R_omega R_phi R_kappa（論文の順序）</translation>
    </message>
    <message>
        <source>R_kappa R_phi R_omega, as bundle adjustments write</source>
        <translation>R_kappa R_phi R_omega（バンドル調整で一般的な順序）</translation>
    </message>
    <message>
        <source>Papers: R_omega R_phi R_kappa. Usual: R_kappa R_phi R_omega, as most bundle adjustments write. (papers, usual)</source>
        <translation>papers：R_omega R_phi R_kappa。usual：多くのバンドル調整と同じR_kappa R_phi R_omega。（papers, usual）</translation>
    </message>
    <message>
        <source>Unit of the angles</source>
        <translation>角度の単位</translation>
    </message>
    <message>
        <source>automatic</source>
        <translation>自動</translation>
    </message>
    <message>
        <source>degrees</source>
        <translation>度</translation>
    </message>
    <message>
        <source>gon</source>
        <translation>ゴン</translation>
    </message>
    <message>
        <source>radians</source>
        <translation>ラジアン</translation>
    </message>
    <message>
        <source>Automatic: degrees, and an error where they look otherwise. (automatic, degrees, gon, radians)</source>
        <translation>automatic：度とみなし、そうでないと見られる場合はエラーとします。（automatic, degrees, gon, radians）</translation>
    </message>
    <message>
        <source>Number of buildings or tiles worked on at the same time. The result does not depend on it.</source>
        <translation>同時に処理する建物またはタイルの数です。結果には影響しません。</translation>
    </message>
    <message>
        <source>Dask scheduler</source>
        <translation>Daskスケジューラ</translation>
    </message>
    <message>
        <source>Address of a Dask cluster that shares the work instead of workers on this machine, such as tcp://host:8786. The result does not depend on it. Inputs, outputs and temporary files must be on storage that all its machines see.</source>
        <translation>このコンピュータの並列処理の代わりに処理を分担するDaskクラスタのアドレスです（例：tcp://host:8786）。結果には影響しません。入力、出力、一時ファイルは、クラスタのすべてのコンピュータから見える場所に置いてください。</translation>
    </message>
    <message>
        <source>Orthophoto</source>
        <translation>オルソ画像</translation>
    </message>
    <message>
        <source>Mosaic of the frames; 0 where there is no data.</source>
        <translation>写真のモザイクです。データのない所は0です。</translation>
    </message>
    <message>
        <source>Frames that see the ground</source>
        <translation>地表が写る写真の数</translation>
    </message>
    <message>
        <source>How many frames see each pixel.</source>
        <translation>各画素が写っている写真の枚数です。</translation>
    </message>
    <message>
        <source>Share of the ground in the frames, outside buildings, that has an image, 0 to 1.</source>
        <translation>写真の範囲内の建物以外の地表のうち、画像のある割合（0～1）です。</translation>
    </message>
    <message>
        <source>Visible share</source>
        <translation>可視の割合</translation>
    </message>
    <message>
        <source>Ground in the frames, outside buildings, that no frame sees.</source>
        <translation>写真の範囲内の建物以外の地表のうち、どの写真にも写らない部分です。</translation>
    </message>
    <message>
        <source>Area of holes</source>
        <translation>欠損部の面積</translation>
    </message>
    <message>
        <source>m²</source>
        <translation>m²</translation>
    </message>
    <message>
        <source>Frames that gave pixels.</source>
        <translation>画素が採用された写真の数です。</translation>
    </message>
    <message>
        <source>Frames used</source>
        <translation>使用した写真</translation>
    </message>
    <message>
        <source>Shifts between images</source>
        <translation>画像間のずれ</translation>
    </message>
    <message>
        <source>Points on road markings that two overlapping images show, with the shift of the second against the first in metres (east, north; sigma of one place), and the median of the pair with its sigma. Pairs that lie more than half a pixel apart have the status “apart”; “height” where only the height of what stands there may displace them, as no surface (DSM) tells; “not alike” where they show different things, as a wrong orientation makes them.</source>
        <translation>重なる2枚の画像に写る道路標示上の点。1枚目に対する2枚目のずれ（メートル、東・北、1か所の標準偏差）と、その組の中央値と標準偏差。半画素を超えてずれる組の状態は “apart”、数値表層モデル（DSM）がなく、そこに立つ物の高さだけでずれうる組は “height”、標定の誤りなどで別の物が写る組は “not alike” です。</translation>
    </message>
    <message>
        <source>Largest distance between the same road markings in two overlapping images that no height of what they show explains, median over their places; no value where none are seen.</source>
        <translation>重なる2枚の画像で、同じ路面標示のずれのうち、写っている物の高さでは説明できないものの最大値（各箇所の中央値）です。ずれが見られない場合は値がありません。</translation>
    </message>
    <message>
        <source>Maximum shift</source>
        <translation>最大のずれ</translation>
    </message>
    <message>
        <source>Points in frames (*.csv *.txt)</source>
        <translation>写真上の点 (*.csv *.txt)</translation>
    </message>
    <message>
        <source>Points in the frames</source>
        <translation>写真上の点</translation>
    </message>
    <message>
        <source>CSV file point,image,column,row,x,y,z: a row for each frame in which a point was measured, pixels from the centre of the upper left one, coordinates in metres, none for tie points; role: control or check.</source>
        <translation>CSV ファイル point,image,column,row,x,y,z。点を測った写真ごとに1行とし、画素は左上の画素の中心から数え、座標はメートル、タイポイントには座標を書きません。role は control（標定点）または check（検証点）です。</translation>
    </message>
    <message>
        <source>Accuracy of the projection centres</source>
        <translation>投影中心の精度</translation>
    </message>
    <message>
        <source>Standard deviation of each frame's own error in metres; what all frames share may be ten times as large.</source>
        <translation>写真ごとの誤差の標準偏差（m）。全写真に共通の誤差はその10倍まで見込みます。</translation>
    </message>
    <message>
        <source>Accuracy of the angles</source>
        <translation>角度の精度</translation>
    </message>
    <message>
        <source>The same of the angles.</source>
        <translation>角度についての同じ値。</translation>
    </message>
    <message>
        <source>Accuracy of the measured places</source>
        <translation>画像座標の精度</translation>
    </message>
    <message>
        <source>pixels</source>
        <translation>画素</translation>
    </message>
    <message>
        <source>Standard deviation of a point's place in a frame.</source>
        <translation>写真上の点の位置の標準偏差。</translation>
    </message>
    <message>
        <source>Standard deviation of their coordinates in metres.</source>
        <translation>座標の標準偏差（m）。</translation>
    </message>
    <message>
        <source>Coordinate system</source>
        <translation>座標系</translation>
    </message>
    <message>
        <source>Of the points and the orientation, for the layer of residuals.</source>
        <translation>点と外部標定要素の座標系。残差のレイヤに使います。</translation>
    </message>
    <message>
        <source>Corrected exterior orientation</source>
        <translation>補正した外部標定要素</translation>
    </message>
    <message>
        <source>Exterior orientation (*.csv)</source>
        <translation>外部標定要素 (*.csv)</translation>
    </message>
    <message>
        <source>As the input, in degrees and the papers' order of angles, with standard deviations.</source>
        <translation>入力と同じ形式で、角度は度、論文の回転順とし、標準偏差を添えます。</translation>
    </message>
    <message>
        <source>Control and check points with their errors on the ground, as given, after, and left out.</source>
        <translation>標定点と検証点。地上での誤差を、入力のまま、調整後、その点を除いた場合について示します。</translation>
    </message>
    <message>
        <source>Errors at the points and accuracy of the frames.</source>
        <translation>各点の誤差と写真の精度。</translation>
    </message>
    <message>
        <source>Number of control points.</source>
        <translation>標定点の数。</translation>
    </message>
    <message>
        <source>RMS error of the control points that do not contradict the others, in plan, as given.</source>
        <translation>他の点と矛盾しない標定点の、与えられた標定での水平位置の RMS 誤差。</translation>
    </message>
    <message>
        <source>RMS error of the check points in plan, after.</source>
        <translation>調整後の検証点の水平誤差の二乗平均平方根。</translation>
    </message>
    <message>
        <source>Adjust frames to control points</source>
        <translation>標定点による写真の調整</translation>
    </message>
    <message>
        <source>Orthophotos</source>
        <translation>オルソ画像</translation>
    </message>
    <message>
        <source>Two or more rasters of the same ground, grey or red, green, blue, of 8 or 16 bit. The result lies on the first.</source>
        <translation>同じ範囲の2枚以上のラスタです。グレーまたは赤・緑・青で、8または16ビットです。結果は1枚目の画素に合わせます。</translation>
    </message>
    <message>
        <source>Majority vote: what most of them agree on, which also keeps dark vehicles from winning over paint. Darkest: the one with the lowest sum of channels. Paper: darkest without gain compensation. (vote, darkest, paper)</source>
        <translation>vote：多数決で、大半の画像が一致する値をとります。暗い車両が標示より優先されることも防ぎます。darkest：チャンネルの和が最小の画像をとります。paper：輝度補正なしの最小輝度合成です。（vote, darkest, paper）</translation>
    </message>
    <message>
        <source>Bring all to one brightness and contrast before they are compared.</source>
        <translation>比較の前に、すべての画像の明るさとコントラストをそろえます。</translation>
    </message>
    <message>
        <source>Without moving vehicles; 0 where there is no data.</source>
        <translation>走行車両を除いた画像です。データのない所は0です。</translation>
    </message>
    <message>
        <source>Share of the pixels that hold an image, 0 to 1.</source>
        <translation>画像のある画素の割合（0～1）です。</translation>
    </message>
    <message>
        <source>Share with data</source>
        <translation>データのある割合</translation>
    </message>
    <message>
        <source>Images (*.tif *.tiff *.jpg *.jpeg *.TIF *.TIFF *.JPG *.JPEG)</source>
        <translation>画像 (*.tif *.tiff *.jpg *.jpeg *.TIF *.TIFF *.JPG *.JPEG)</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>写真</translation>
    </message>
    <message>
        <source>The image: TIFF or JPEG, 8 or 16 bit.</source>
        <translation>画像ファイルです。TIFFまたはJPEG、8または16ビットです。</translation>
    </message>
    <message>
        <source>JSON with focal_length_mm, pixel_pitch_mm, image_width, image_height, principal_point_mm and distortion, if there is any.</source>
        <translation>focal_length_mm、pixel_pitch_mm、image_width、image_height、principal_point_mmと、歪みがあればdistortionを持つJSONです。</translation>
    </message>
    <message>
        <source>Table (*.csv *.txt)</source>
        <translation>表 (*.csv *.txt)</translation>
    </message>
    <message>
        <source>CSV with the columns image, x, y, z, omega, phi, kappa, or what Metashape or Pix4D wrote; the frame is found by its file name.</source>
        <translation>列 image、x、y、z、omega、phi、kappa の CSV、または Metashape か Pix4D が出力したファイル。写真はファイル名で探します。</translation>
    </message>
    <message>
        <source>Heights of the surface, from “Surface and ground from ALS”, in the CRS and height system of the exterior orientation.</source>
        <translation>「航空レーザからの表層と地表」による表層の標高です。座標参照系と高さの基準は外部標定要素と同じにします。</translation>
    </message>
    <message>
        <source>Heights of the ground, likewise.</source>
        <translation>地表の標高です。条件は表層と同じです。</translation>
    </message>
    <message>
        <source>Surface higher than this above the ground, in metres, is masked: more than the highest vehicle.</source>
        <translation>地表からこの高さ（m）を超える表層をマスクします。最も高い車両より大きくしてください。</translation>
    </message>
    <message>
        <source>Buildings that are masked even if they are lower than the threshold or partly missing in the surface. Outlines where nothing stands are left alone.</source>
        <translation>しきい値より低い建物や、表層で一部欠けている建物もマスクします。何も建っていない外周線は対象外です。</translation>
    </message>
    <message>
        <source>Low parts of buildings</source>
        <translation>建物の低い部分</translation>
    </message>
    <message>
        <source>Podiums and annexes lower than the threshold are masked too: higher than 2.5 m, wider than 4 m, within 15 m of something above the threshold.</source>
        <translation>しきい値より低い基壇や附属部分もマスクします。対象は、高さ2.5 m超、幅4 m超で、しきい値を超える物から15 m以内のものです。</translation>
    </message>
    <message>
        <source>Steep walls</source>
        <translation>急な壁</translation>
    </message>
    <message>
        <source>Walls drop from one cell of the surface to the next.</source>
        <translation>壁は表層の1セルから隣のセルへ垂直に落ちるものとします。</translation>
    </message>
    <message>
        <source>Walls at the cells' borders</source>
        <translation>セル境界の壁</translation>
    </message>
    <message>
        <source>Walls stand at the border between a raised cell and a low one, not at the cells' centres.</source>
        <translation>壁は、セルの中心ではなく、高いセルと低いセルの境界に立つものとします。</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>方法</translation>
    </message>
    <message>
        <source>refined</source>
        <translation>改良版</translation>
    </message>
    <message>
        <source>Refined: as set above. Paper: the triangles of the surface higher than the threshold as they are; low parts, steep walls and walls at the cells' borders are off. (refined, paper)</source>
        <translation>refined：上の設定に従います。paper：しきい値を超える表層の三角形をそのまま使い、低い部分、急な壁、セル境界の壁は無効です。（refined, paper）</translation>
    </message>
    <message>
        <source>Automatic takes degrees and stops where the angles look like gon or radians. (automatic, degrees, gon, radians)</source>
        <translation>automaticは度とみなし、角度がゴンまたはラジアンらしい場合は停止します。（automatic, degrees, gon, radians）</translation>
    </message>
    <message>
        <source>R_omega R_phi R_kappa as in the papers, or the usual R_kappa R_phi R_omega of most bundle adjustments. (papers, usual)</source>
        <translation>papersは論文と同じR_omega R_phi R_kappa、usualは多くのバンドル調整で一般的なR_kappa R_phi R_omegaです。（papers, usual）</translation>
    </message>
    <message>
        <source>Occlusion map</source>
        <translation>遮蔽図</translation>
    </message>
    <message>
        <source>255 = shows a building or is hidden by one, otherwise 0.</source>
        <translation>255は建物が写る所、または建物に隠れる所です。それ以外は0です。</translation>
    </message>
    <message>
        <source>Share of the frame that is masked, 0 to 1.</source>
        <translation>写真のうちマスクされた割合（0～1）です。</translation>
    </message>
    <message>
        <source>Hidden share</source>
        <translation>遮蔽の割合</translation>
    </message>
    <message>
        <source>Share of the frame that looks beyond the surface or the ground, where nothing is masked, 0 to 1.</source>
        <translation>写真のうち、表層または地表の範囲外で、何もマスクされない部分の割合（0～1）です。</translation>
    </message>
    <message>
        <source>Share not covered</source>
        <translation>範囲外の割合</translation>
    </message>
    <message>
        <source>Outlines that were masked.</source>
        <translation>マスクされた外周線の数です。</translation>
    </message>
    <message>
        <source>Outlines with a building</source>
        <translation>建物のある外周線</translation>
    </message>
    <message>
        <source>Outlines near the frame in which the surface shows nothing that stands.</source>
        <translation>写真の近くにあり、表層に立つ物が見られない外周線の数です。</translation>
    </message>
    <message>
        <source>Outlines without a building</source>
        <translation>建物のない外周線</translation>
    </message>
    <message>
        <source>Aerial image on the ground, in a projected CRS (metres or feet).</source>
        <translation>地上に投影された空中写真画像です。投影座標参照系（mまたはフィート）を持つ必要があります。</translation>
    </message>
    <message>
        <source>No markings are looked for inside these polygons.</source>
        <translation>このポリゴンの内側では路面標示を探しません。</translation>
    </message>
    <message>
        <source>Hidden areas</source>
        <translation>遮蔽域</translation>
    </message>
    <message>
        <source>Raster that is above 0 where the ground is not seen, such as an occlusion mask. Its cells may differ from the orthophoto's.</source>
        <translation>地表が見えない所で0より大きいラスタです（遮蔽マスクなど）。セルはオルソ画像と異なってもかまいません。</translation>
    </message>
    <message>
        <source>Roads</source>
        <translation>道路</translation>
    </message>
    <message>
        <source>Markings are looked for only inside these polygons; without them, everywhere.</source>
        <translation>このポリゴンの内側だけで路面標示を探します。指定しない場合は全域で探します。</translation>
    </message>
    <message>
        <source>Ground heights in metres, in the orthophoto's CRS: gives the polygons their heights.</source>
        <translation>オルソ画像の座標参照系での地表の標高（m）です。ポリゴンに標高を与えます。</translation>
    </message>
    <message>
        <source>brighter than the road on both sides</source>
        <translation>両側の路面より明るい部分</translation>
    </message>
    <message>
        <source>with a model trained on made-up streets</source>
        <translation>模擬街路で学習したモデルによる</translation>
    </message>
    <message>
        <source>Profile: paint must stand out from the road on both sides, and what is no paint is left out. Paper: the plain adaptive Gaussian threshold of the grey image after a level adjustment, as in the paper; only block size and contrast matter then. Trained: the same as profile. (profile, paper, trained)</source>
        <translation>断面：標示は道路より両側で際立たねばならず、標示でないものは除かれる。論文：論文のとおり、レベル補正後の濃淡画像への単純な適応ガウス閾値処理で、ブロックの大きさとコントラストだけが効く。学習済み：断面と同じ。（profile、paper、trained）</translation>
    </message>
    <message>
        <source>Block size</source>
        <translation>ブロックサイズ</translation>
    </message>
    <message>
        <source>Side of the block over which the mean is taken.</source>
        <translation>平均をとるブロックの一辺です。</translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation>コントラスト</translation>
    </message>
    <message>
        <source>grey values</source>
        <translation>階調</translation>
    </message>
    <message>
        <source>How much brighter than the mean paint is, in grey values of an image that goes from 0 to 255 after the level adjustment, whatever its bit depth.</source>
        <translation>標示が平均よりどれだけ明るいかを、画像のビット数によらず、レベル補正後の0～255の階調値で指定します。</translation>
    </message>
    <message>
        <source>Clean</source>
        <translation>標示以外の除去</translation>
    </message>
    <message>
        <source>Leave out what is no paint by its width, contrast on both sides, shape and surroundings; without it all stays that is brighter by the contrast than the block.</source>
        <translation>幅、両側のコントラスト、形状、周囲の状況から、標示でないものを除きます。無効の場合は、ブロックよりコントラスト分だけ明るいものをすべて残します。</translation>
    </message>
    <message>
        <source>Maximum stroke width</source>
        <translation>線の最大幅</translation>
    </message>
    <message>
        <source>What is wider than this in every direction is no paint.</source>
        <translation>どの方向にもこれより幅の広いものは標示とみなしません。</translation>
    </message>
    <message>
        <source>Minimum marking area</source>
        <translation>路面標示の最小面積</translation>
    </message>
    <message>
        <source>Smaller pieces are left out.</source>
        <translation>これより小さいものは除きます。</translation>
    </message>
    <message>
        <source>Minimum confidence</source>
        <translation>最小信頼度</translation>
    </message>
    <message>
        <source>What is less likely paint than this, 0 to 1, is left out (parts of long pieces by themselves); at the default 60 to 85 % of the found area were paint on eight sunlit orthophotos. 0 keeps all. Where roads are given, paint is more likely.</source>
        <translation>標示である確からしさ（0〜1）がこれより低いもの（長いものは部分ごと）を除く。既定値では、日照下のオルソ画像8枚で抽出面積の60〜85 %が標示であった。0はすべてを残す。道路を与えると標示の確からしさは高くなる。</translation>
    </message>
    <message>
        <source>Width of filled paint</source>
        <translation>塗りつぶし標示の幅</translation>
    </message>
    <message>
        <source>Paint up to this width, such as arrow heads and letters, is filled between its edges; at most the maximum stroke width fills nothing.</source>
        <translation>矢印の先端や文字など、この幅までの標示は縁と縁の間を塗りつぶします。線の最大幅以下の値では塗りつぶしません。</translation>
    </message>
    <message>
        <source>Points of “Orthorectify frames” that tell how far the frames of this orthophoto disagree; shown in the report.</source>
        <translation>「写真のオルソ補正」による点で、このオルソ画像の写真間の不一致の大きさを示します。報告書に表示します。</translation>
    </message>
    <message>
        <source>Raster of “Orthorectify frames”; shown in the report.</source>
        <translation>「写真のオルソ補正」によるラスタです。報告書に表示します。</translation>
    </message>
    <message>
        <source>Note for the report</source>
        <translation>報告書の注記</translation>
    </message>
    <message>
        <source>Text that the report shows with its settings.</source>
        <translation>報告書に設定とともに表示する文章です。</translation>
    </message>
    <message>
        <source>Levels</source>
        <translation>レベル</translation>
    </message>
    <message>
        <source>Brightness (three numbers) and road (four) of the whole image that this one is a part of; a run over tiles gives them. Left out: of this image.</source>
        <translation>この画像を含む元画像全体の明るさ（三つの数値）と道路（四つの数値）。タイルごとの処理では自動で渡されます。省略時はこの画像自身から求めます。</translation>
    </message>
    <message>
        <source>Marking mask</source>
        <translation>路面標示マスク</translation>
    </message>
    <message>
        <source>255 where there is a marking, otherwise 0; pixels as the orthophoto's.</source>
        <translation>路面標示のある所は255、それ以外は0です。画素はオルソ画像と同じです。</translation>
    </message>
    <message>
        <source>Road markings</source>
        <translation>路面標示</translation>
    </message>
    <message>
        <source>Outlines of the markings, with area (m2), length and width of the stroke (m), mean contrast (grey values), colour and confidence (0 to 1).</source>
        <translation>路面標示の輪郭です。面積（m2）、線の長さと幅（m）、平均コントラスト（階調値）、色、信頼度（0～1）を持ちます。</translation>
    </message>
    <message>
        <source>Doubtful markings</source>
        <translation>疑わしい路面標示</translation>
    </message>
    <message>
        <source>What was left out with a confidence of 0.2 or more, the most area in doubt first, with the empty field paint for your answers when you look through it.</source>
        <translation>信頼度0.2以上で除かれたもの。疑わしい面積の大きい順で、確認時に答えを記入する空の属性 paint をもつ。</translation>
    </message>
    <message>
        <source>HTML report: numbers and areas, shifts between frames, coverage, pictures of the markings over the orthophoto, and what to distrust.</source>
        <translation>HTML報告書です。個数と面積、写真間のずれ、被覆率、オルソ画像に重ねた路面標示の図、信頼できない箇所を示します。</translation>
    </message>
    <message>
        <source>Number of polygons.</source>
        <translation>ポリゴンの数です。</translation>
    </message>
    <message>
        <source>Markings</source>
        <translation>路面標示</translation>
    </message>
    <message>
        <source>Area of the mask's markings.</source>
        <translation>マスクの路面標示の面積です。</translation>
    </message>
    <message>
        <source>Marked area</source>
        <translation>路面標示の面積</translation>
    </message>
    <message>
        <source>Area in which markings could be found.</source>
        <translation>路面標示の検出が可能な範囲の面積です。</translation>
    </message>
    <message>
        <source>Searched area</source>
        <translation>探索面積</translation>
    </message>
    <message>
        <source>Road markings from orthophoto</source>
        <translation>オルソ画像からの路面標示</translation>
    </message>
    <message>
        <source>Side of a raster cell in metres. Finer than the distance between points shows nothing more.</source>
        <translation>ラスタのセルの一辺（m）です。点間隔より細かくしても情報は増えません。</translation>
    </message>
    <message>
        <source>Ground points</source>
        <translation>地表面点</translation>
    </message>
    <message>
        <source>classes of the points</source>
        <translation>点のクラス</translation>
    </message>
    <message>
        <source>cloth filter</source>
        <translation>クロスフィルタ</translation>
    </message>
    <message>
        <source>How ground points are told. Automatic: by class where at least 1 % of the points have a ground class, otherwise by the cloth filter. (automatic, classes, cloth)</source>
        <translation>地表面点の判定方法です。automaticは、1 %以上の点が地表面クラスを持つ場合はクラスにより、それ以外は布シミュレーションフィルタによります。（automatic, classes, cloth）</translation>
    </message>
    <message>
        <source>Cloth resolution</source>
        <translation>布の解像度</translation>
    </message>
    <message>
        <source>Distance in metres between the nodes of the cloth. Smaller follows the ground closer; larger spans more.</source>
        <translation>布の節点の間隔（m）です。小さいほど地表によく沿い、大きいほど広い隙間をまたぎます。</translation>
    </message>
    <message>
        <source>Cloth threshold</source>
        <translation>布のしきい値</translation>
    </message>
    <message>
        <source>Points within this height, in metres, above or below the cloth are ground.</source>
        <translation>布の上下この高さ（m）以内の点を地表面点とします。</translation>
    </message>
    <message>
        <source>Cloth iterations</source>
        <translation>布の反復回数</translation>
    </message>
    <message>
        <source>Maximum number of sweeps on each level of detail; the cloth stops earlier when it has converged.</source>
        <translation>各詳細度での最大反復回数です。収束すればそれより早く終わります。</translation>
    </message>
    <message>
        <source>Cloth rigidness</source>
        <translation>布の剛性</translation>
    </message>
    <message>
        <source>3 for towns and large buildings, 2 for hills, 1 for steep mountains.</source>
        <translation>市街地と大きな建物は3、丘陵は2、急峻な山地は1です。</translation>
    </message>
    <message>
        <source>Maximum edge length</source>
        <translation>辺の最大長</translation>
    </message>
    <message>
        <source>Triangles of the surface with a longer side in plan, in metres, are left out, so that water and gaps stay empty; 0 keeps all.</source>
        <translation>水平距離でこれより長い辺（m）を持つ表層の三角形を除き、水面や欠測部を空けておきます。0の場合はすべて残します。</translation>
    </message>
    <message>
        <source>Ground in gaps</source>
        <translation>欠測部の地表</translation>
    </message>
    <message>
        <source>Where triangles were left out, the surface takes the height of the ground instead of staying empty.</source>
        <translation>三角形を除いた所を空けずに、表層に地表の標高を与えます。</translation>
    </message>
    <message>
        <source>Heights of the surface (DSM) in metres.</source>
        <translation>表層（DSM）の標高（m）です。</translation>
    </message>
    <message>
        <source>Heights of the ground in metres, without gaps inside the surface's outline.</source>
        <translation>地表の標高（m）です。表層の範囲内に欠測はありません。</translation>
    </message>
    <message>
        <source>Surface mesh</source>
        <translation>表層メッシュ</translation>
    </message>
    <message>
        <source>PLY mesh (*.ply)</source>
        <translation>PLYメッシュ (*.ply)</translation>
    </message>
    <message>
        <source>The triangles of the surface as binary PLY, which QGIS opens as a mesh layer.</source>
        <translation>表層の三角形をバイナリPLYで出力します。QGISではメッシュレイヤとして開けます。</translation>
    </message>
    <message>
        <source>All points in the files.</source>
        <translation>ファイル内のすべての点の数です。</translation>
    </message>
    <message>
        <source>Points read</source>
        <translation>読み込んだ点</translation>
    </message>
    <message>
        <source>Points that are not noise or withheld.</source>
        <translation>ノイズおよび除外フラグのない点の数です。</translation>
    </message>
    <message>
        <source>Points used</source>
        <translation>使用した点</translation>
    </message>
    <message>
        <source>Ground points as a share of the points used, 0 to 1; no value without a ground raster.</source>
        <translation>使用した点のうち地表面点の割合（0～1）です。地表のラスタがない場合は値がありません。</translation>
    </message>
    <message>
        <source>Ground share</source>
        <translation>地表面点の割合</translation>
    </message>
    <message>
        <source>Share of the surface's cells without a height, 0 to 1.</source>
        <translation>表層のセルのうち標高のないものの割合（0～1）です。</translation>
    </message>
    <message>
        <source>Empty share</source>
        <translation>空白の割合</translation>
    </message>
    <message>
        <source>Share of the cells in triangles with a side of 10 m or more, where the surface is a guess, 0 to 1.</source>
        <translation>10 m以上の辺を持つ三角形内のセルの割合（0～1）です。そこでは表層は推定にすぎません。</translation>
    </message>
    <message>
        <source>Share far from points</source>
        <translation>点から遠い割合</translation>
    </message>
    <message>
        <source>Triangles of the surface.</source>
        <translation>表層の三角形の数です。</translation>
    </message>
    <message>
        <source>Triangles</source>
        <translation>三角形</translation>
    </message>
    <message>
        <source>Those longer than the longest edge.</source>
        <translation>辺の最大長を超える三角形の数です。</translation>
    </message>
    <message>
        <source>Triangles left out</source>
        <translation>除いた三角形</translation>
    </message>
    <message>
        <source>The drives: LAS, LAZ or COPC files with intensities and GPS times, or their markings as “Road markings of a mobile survey” writes them. Each file belongs to the trajectory along which it was measured.</source>
        <translation>各走行のデータです。反射強度とGPS時刻を持つLAS、LAZまたはCOPCファイル、または「MMS計測の路面標示」が出力した路面標示を指定します。各ファイルは、計測時の軌跡に対応付けます。</translation>
    </message>
    <message>
        <source>Trajectories</source>
        <translation>軌跡</translation>
    </message>
    <message>
        <source>The trajectory of each drive, with which its points were placed: CSV time,x,y,z,roll,pitch,heading, SBET, or point layers.</source>
        <translation>各走行の点の座標付けに使った軌跡です。CSV time,x,y,z,roll,pitch,heading、SBET、または点レイヤを指定します。</translation>
    </message>
    <message>
        <source>Trajectory (*.csv *.txt *.out *.sbet *.gpkg *.shp *.geojson)</source>
        <translation>走行軌跡 (*.csv *.txt *.out *.sbet *.gpkg *.shp *.geojson)</translation>
    </message>
    <message>
        <source>Angles of the trajectory</source>
        <translation>軌跡の角度</translation>
    </message>
    <message>
        <source>degrees, headings counter-clockwise from east</source>
        <translation>度（方位は東から反時計回り）</translation>
    </message>
    <message>
        <source>radians, headings counter-clockwise from east</source>
        <translation>ラジアン（方位は東から反時計回り）</translation>
    </message>
    <message>
        <source>How roll, pitch and heading of tables and layers are counted: degrees or radians, headings clockwise from grid north or counter-clockwise from east. SBET says it itself. (degrees, radians, degrees_from_east, radians_from_east)</source>
        <translation>表とレイヤのroll、pitch、headingの表し方です。度またはラジアンで、方位は座標北から時計回り、または東から反時計回りです。SBETでは指定不要です。（degrees, radians, degrees_from_east, radians_from_east）</translation>
    </message>
    <message>
        <source>Geoid model (*.tif *.tiff *.gtx *.asc *.isg);;All files (*)</source>
        <translation>ジオイドモデル (*.tif *.tiff *.gtx *.asc *.isg);;すべてのファイル (*)</translation>
    </message>
    <message>
        <source>Geoid model</source>
        <translation>ジオイドモデル</translation>
    </message>
    <message>
        <source>GeoTIFF, GTX or text grid of GSI (.asc, .isg) of the geoid's heights above the ellipsoid: with it the ellipsoidal heights of SBET become heights above sea level, as those of the points must be.</source>
        <translation>楕円体からのジオイド高のGeoTIFF、GTX、または国土地理院のテキストグリッド（.asc, .isg）です。これによりSBETの楕円体高を標高に変換します。点の高さも標高である必要があります。</translation>
    </message>
    <message>
        <source>Height of the geoid</source>
        <translation>ジオイド高</translation>
    </message>
    <message>
        <source>One height above the ellipsoid for all places, instead of a model.</source>
        <translation>モデルの代わりに、すべての場所に適用する1つのジオイド高です。</translation>
    </message>
    <message>
        <source>Calibration (*.json)</source>
        <translation>校正値 (*.json)</translation>
    </message>
    <message>
        <source>Calibration</source>
        <translation>校正値</translation>
    </message>
    <message>
        <source>JSON file of the scanners' (and cameras') lever arms and angles on the vehicle.</source>
        <translation>車両上のスキャナ（およびカメラ）のレバーアームと取付角のJSONファイルです。</translation>
    </message>
    <message>
        <source>CSV or layer with the columns id,x,y,z (where a point truly lies, metres) and time,x_mms,y_mms,z_mms (when the survey measured it, GPS seconds, and where it lies in the survey). Heights may be missing.</source>
        <translation>id,x,y,z（点の正しい位置、m）とtime,x_mms,y_mms,z_mms（計測時刻（GPS秒）と計測データ上の位置）の列を持つCSVまたはレイヤです。高さはなくてもかまいません。</translation>
    </message>
    <message>
        <source>Coordinate reference system</source>
        <translation>座標参照系</translation>
    </message>
    <message>
        <source>Coordinate reference system of the control points, where their layer does not say it (CSV). It is needed for SBET trajectories.</source>
        <translation>基準点・検証点のレイヤに記載がない場合（CSV）の座標参照系です。SBETの軌跡では必須です。</translation>
    </message>
    <message>
        <source>Reference markings</source>
        <translation>基準の路面標示</translation>
    </message>
    <message>
        <source>The reference: a raster whose cells are above 0 where there is paint, or marking polygons. “Road markings from orthophoto” makes both.</source>
        <translation>基準データです。標示のある所でセルが0より大きいラスタ、または路面標示のポリゴンを指定します。どちらも「オルソ画像からの路面標示」で作成できます。</translation>
    </message>
    <message>
        <source>Ground elevation</source>
        <translation>地表の標高</translation>
    </message>
    <message>
        <source>Heights of the ground in metres, for the reference markings.</source>
        <translation>基準の路面標示に与える地表の標高（m）です。</translation>
    </message>
    <message>
        <source>Outlines, or models with their heights (MultiPolygonZ of “Building models” or “Load city model”), whose walls are a second witness beside the markings. How far facades stand inside them is found.</source>
        <translation>外形線、または高さ付きのモデル（「建物モデル」や「都市モデルの読み込み」の MultiPolygonZ）。その壁面を標示と並ぶ第二の根拠とします。壁面が外形線よりどれだけ内側にあるかは推定します。</translation>
    </message>
    <message>
        <source>Features</source>
        <translation>地物</translation>
    </message>
    <message>
        <source>road markings alone</source>
        <translation>路面標示のみ</translation>
    </message>
    <message>
        <source>walls</source>
        <translation>壁面</translation>
    </message>
    <message>
        <source>all: markings and walls</source>
        <translation>すべて（標示と壁面）</translation>
    </message>
    <message>
        <source>What the survey is laid by. Automatic: paint, and walls where buildings are given. Paint: the markings alone. Walls: the markings give the start only. All: both; without buildings walls tell the pitch alone. (automatic, paint, walls, all)</source>
        <translation>位置合わせに使う地物。automatic：標示、建物が指定されていれば壁面も。paint：標示だけ。walls：標示は初期値だけに使う。all：両方。建物がなければ、壁面はピッチだけを示します。(automatic, paint, walls, all)</translation>
    </message>
    <message>
        <source>Airborne laser points</source>
        <translation>航空レーザ点群</translation>
    </message>
    <message>
        <source>Instead of buildings: walls stand where these points step from roof to ground beside facades that the survey saw. In the height system of the survey.</source>
        <translation>建物の代わりに使います。計測に写った建物正面のそばで、この点群が屋根から地面へ段差をなす位置を壁とします。高さの基準は計測と同じものにします。</translation>
    </message>
    <message>
        <source>Accuracy of control in plan</source>
        <translation>基準点の水平精度</translation>
    </message>
    <message>
        <source>Standard deviation of control points and of their measurement in the survey.</source>
        <translation>基準点と、計測データ上でのその測定の標準偏差です。</translation>
    </message>
    <message>
        <source>Accuracy of control in height</source>
        <translation>基準点の高さの精度</translation>
    </message>
    <message>
        <source>The same in height.</source>
        <translation>高さについての同様の値です。</translation>
    </message>
    <message>
        <source>Maximum error</source>
        <translation>最大誤差</translation>
    </message>
    <message>
        <source>How far drives may lie apart in plan.</source>
        <translation>走行間の水平位置のずれの最大値です。</translation>
    </message>
    <message>
        <source>Ties by planes</source>
        <translation>平面による結合</translation>
    </message>
    <message>
        <source>Facades and road that two drives saw tie them too, across the facades and in height. Markings alone carry no planes.</source>
        <translation>2つの走行の両方で計測された壁面と路面でも、壁面の法線方向と高さについて走行を結合します。路面標示だけの点群には平面がありません。</translation>
    </message>
    <message>
        <source>Corrected trajectories</source>
        <translation>補正後の軌跡</translation>
    </message>
    <message>
        <source>Folder in which each trajectory is written under its own name.</source>
        <translation>各軌跡を元の名称で書き出すフォルダです。</translation>
    </message>
    <message>
        <source>Ties</source>
        <translation>結合点</translation>
    </message>
    <message>
        <source>One point an observation: its residual (m), its standard deviation and the weight that it kept.</source>
        <translation>観測ごとに1点です。残差（m）、標準偏差、最終的な重みを持ちます。</translation>
    </message>
    <message>
        <source>Corrections</source>
        <translation>補正量</translation>
    </message>
    <message>
        <source>Points along the corrected paths, with correction, standard deviations and status.</source>
        <translation>補正後の軌跡に沿う点です。補正量、標準偏差、状態を持ちます。</translation>
    </message>
    <message>
        <source>Residuals by kind, the share of each witness, corrections and their uncertainty, what to distrust.</source>
        <translation>種類ごとの残差、各観測の寄与、補正量とその不確かさ、信頼できない箇所。</translation>
    </message>
    <message>
        <source>Number of ties between drives.</source>
        <translation>走行間の結合点の数です。</translation>
    </message>
    <message>
        <source>Number of ties by facades and road.</source>
        <translation>壁面と路面による結合の数です。</translation>
    </message>
    <message>
        <source>Number of observations on walls of buildings.</source>
        <translation>建物の壁による観測の数。</translation>
    </message>
    <message>
        <source>Walls</source>
        <translation>壁面</translation>
    </message>
    <message>
        <source>Of their residuals.</source>
        <translation>結合の残差についての値です。</translation>
    </message>
    <message>
        <source>RMS of ties in plan</source>
        <translation>結合の水平残差のRMS</translation>
    </message>
    <message>
        <source>In plan, over all drives.</source>
        <translation>全走行の水平位置についての値です。</translation>
    </message>
    <message>
        <source>Median standard deviation</source>
        <translation>標準偏差の中央値</translation>
    </message>
    <message>
        <source>1 where nothing fixes the place of the drives, otherwise 0.</source>
        <translation>走行の位置を固定するものがない場合は1、それ以外は0です。</translation>
    </message>
    <message>
        <source>Relative only</source>
        <translation>相対位置のみ</translation>
    </message>
    <message>
        <source>Adjust several drives</source>
        <translation>複数走行の調整</translation>
    </message>
    <message>
        <source>The survey: one or several LAS, LAZ or COPC files with GPS times, as the reported trajectory places it.</source>
        <translation>計測データです。GPS時刻を持ち、補正前の軌跡で座標付けされた1つまたは複数のLAS、LAZまたはCOPCファイルを指定します。</translation>
    </message>
    <message>
        <source>Trajectory (*.csv *.txt *.out *.sbet *.gpkg *.shp *.geojson);;All files (*)</source>
        <translation>軌跡 (*.csv *.txt *.out *.sbet *.gpkg *.shp *.geojson);;すべてのファイル (*)</translation>
    </message>
    <message>
        <source>Reported trajectory</source>
        <translation>補正前の軌跡</translation>
    </message>
    <message>
        <source>The trajectory with which the survey was placed: CSV time,x,y,z,roll,pitch,heading, SBET, or a point layer with these fields.</source>
        <translation>計測データの座標付けに使った軌跡です。CSV time,x,y,z,roll,pitch,heading、SBET、またはこれらのフィールドを持つ点レイヤを指定します。</translation>
    </message>
    <message>
        <source>Corrected trajectory</source>
        <translation>補正後の軌跡</translation>
    </message>
    <message>
        <source>The same after the correction.</source>
        <translation>補正後の同じ軌跡です。</translation>
    </message>
    <message>
        <source>Image poses (*.csv *.txt)</source>
        <translation>画像の位置姿勢 (*.csv *.txt)</translation>
    </message>
    <message>
        <source>Image poses</source>
        <translation>画像の位置姿勢</translation>
    </message>
    <message>
        <source>CSV id,time,x,y,z,roll,pitch,heading of the survey's images, angles counted as those of the trajectory.</source>
        <translation>計測画像の CSV（id,time,x,y,z,roll,pitch,heading）。角の数え方は走行軌跡と同じです。</translation>
    </message>
    <message>
        <source>Points outside the trajectory</source>
        <translation>軌跡の範囲外の点</translation>
    </message>
    <message>
        <source>move with the nearest pose</source>
        <translation>最も近い姿勢で動かす</translation>
    </message>
    <message>
        <source>leave as they are</source>
        <translation>そのままにする</translation>
    </message>
    <message>
        <source>refuse to run</source>
        <translation>処理を中止する</translation>
    </message>
    <message>
        <source>What is done with points that were measured before the trajectory begins or after it ends: move them with its nearest pose, keep them where they are, or refuse to run. Their number is told. (move, keep, refuse)</source>
        <translation>軌跡の開始前または終了後に計測された点の扱いです。move：最も近い位置姿勢で動かします。keep：そのままにします。refuse：処理を中止します。点の数は表示されます。（move, keep, refuse）</translation>
    </message>
    <message>
        <source>Corrected survey</source>
        <translation>補正後の計測データ</translation>
    </message>
    <message>
        <source>Corrected image poses</source>
        <translation>補正後の画像の位置姿勢</translation>
    </message>
    <message>
        <source>The same rows with corrected poses.</source>
        <translation>同じ行に補正後の位置姿勢を入れたものです。</translation>
    </message>
    <message>
        <source>Points written.</source>
        <translation>書き出した点の数です。</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>点</translation>
    </message>
    <message>
        <source>Points measured outside the trajectory's time.</source>
        <translation>軌跡の時間外に計測された点の数です。</translation>
    </message>
    <message>
        <source>Points outside</source>
        <translation>範囲外の点</translation>
    </message>
    <message>
        <source>Points measured in gaps of a trajectory of more than a second.</source>
        <translation>軌跡の1秒を超える欠測区間で計測された点の数です。</translation>
    </message>
    <message>
        <source>Points in gaps</source>
        <translation>欠測区間の点</translation>
    </message>
    <message>
        <source>Mean length of the movements.</source>
        <translation>移動量の平均です。</translation>
    </message>
    <message>
        <source>Mean movement</source>
        <translation>平均移動量</translation>
    </message>
    <message>
        <source>Maximum length of a movement.</source>
        <translation>移動量の最大値です。</translation>
    </message>
    <message>
        <source>Maximum movement</source>
        <translation>最大移動量</translation>
    </message>
    <message>
        <source>The survey: LAS, LAZ or COPC files with GPS times and the number of the scanner as point source id. Each file belongs to the trajectory along which it was measured.</source>
        <translation>計測データです。GPS時刻を持ち、スキャナ番号をpoint source idとするLAS、LAZまたはCOPCファイルを指定します。各ファイルは、計測時の軌跡に対応付けます。</translation>
    </message>
    <message>
        <source>Difference of tilts</source>
        <translation>傾きの差</translation>
    </message>
    <message>
        <source>Standard deviation by which roll and pitch of the trajectory differ from pass to pass.</source>
        <translation>走行パス間での軌跡のrollとpitchの差の標準偏差です。</translation>
    </message>
    <message>
        <source>Difference of headings</source>
        <translation>方位の差</translation>
    </message>
    <message>
        <source>The same of the heading.</source>
        <translation>方位についての同様の値です。</translation>
    </message>
    <message>
        <source>Corrected calibration</source>
        <translation>補正後の校正値</translation>
    </message>
    <message>
        <source>The calibration file with corrected values; for each its standard deviation, or that it is not determined.</source>
        <translation>値を補正した校正ファイルです。各値に、標準偏差、または決定できないことを記します。</translation>
    </message>
    <message>
        <source>Table: scanner, parameter, correction, standard deviation, status.</source>
        <translation>表：スキャナ、パラメータ、補正量、標準偏差、状態。</translation>
    </message>
    <message>
        <source>Corrections with their standard deviations, and how far planes lie apart before and after.</source>
        <translation>補正量と標準偏差、および補正前後の平面間のずれを示します。</translation>
    </message>
    <message>
        <source>Planes that were compared.</source>
        <translation>比較した平面の数です。</translation>
    </message>
    <message>
        <source>Pairs of planes</source>
        <translation>平面の組</translation>
    </message>
    <message>
        <source>Distance between planes before, trajectories corrected.</source>
        <translation>補正前の平面間の距離です（軌跡は補正済み）。</translation>
    </message>
    <message>
        <source>Distance between planes after.</source>
        <translation>補正後の平面間の距離です。</translation>
    </message>
    <message>
        <source>Number of values that are determined.</source>
        <translation>決定された値の数です。</translation>
    </message>
    <message>
        <source>Determined</source>
        <translation>決定された値</translation>
    </message>
    <message>
        <source>Calibrate scanners</source>
        <translation>スキャナの校正</translation>
    </message>
    <message>
        <source>Minimum ground share</source>
        <translation>地表面点の最小割合</translation>
    </message>
    <message>
        <source>A smaller share of ground among the points, 0 to 1, is refused: it shows that the filter has failed. 0 accepts every share.</source>
        <translation>点のうち地表面点の割合（0～1）がこれより小さい場合は、フィルタの失敗とみなして処理を中止します。0の場合はどの割合でも受け入れます。</translation>
    </message>
    <message>
        <source>Classified points</source>
        <translation>分類済みの点</translation>
    </message>
    <message>
        <source>All points; ground has class 2, what was undecided and is no ground class 1.</source>
        <translation>すべての点です。地表面はクラス2、判定されず地表面でないものはクラス1です。</translation>
    </message>
    <message>
        <source>Points of class 2 in the result.</source>
        <translation>結果のうちクラス2の点の数です。</translation>
    </message>
    <message>
        <source>Ground points as a share of the points used, 0 to 1.</source>
        <translation>使用した点のうち地表面点の割合（0～1）です。</translation>
    </message>
    <message>
        <source>Passes through the same place that were filtered apart.</source>
        <translation>同じ場所を通り、別々にフィルタ処理した走行パスの数です。</translation>
    </message>
    <message>
        <source>Passes</source>
        <translation>走行パス</translation>
    </message>
    <message>
        <source>Trajectory</source>
        <translation>軌跡</translation>
    </message>
    <message>
        <source>Where the vehicle was: CSV time,x,y,z,roll,pitch,heading (GPS seconds, metres, degrees), Applanix SBET, or a point layer with these fields.</source>
        <translation>車両の位置です。CSV time,x,y,z,roll,pitch,heading（GPS秒、m、度）、Applanix SBET、またはこれらのフィールドを持つ点レイヤを指定します。</translation>
    </message>
    <message>
        <source>The same epochs in the format of the trajectory given.</source>
        <translation>元の軌跡と同じ形式、同じエポックで出力します。</translation>
    </message>
    <message>
        <source>Those measured during the survey.</source>
        <translation>計測時間中に観測された検証点の数です。</translation>
    </message>
    <message>
        <source>Control points used</source>
        <translation>使用した検証点</translation>
    </message>
    <message>
        <source>A survey (LAS, LAZ or COPC with intensities and GPS times) or, faster, its markings as “Road markings of a mobile survey” writes them.</source>
        <translation>計測データ（反射強度とGPS時刻を持つLAS、LAZまたはCOPC）です。「MMS計測の路面標示」が出力した路面標示を指定すると、より速く処理できます。</translation>
    </message>
    <message>
        <source>Where the vehicle was: CSV time,x,y,z,roll,pitch,heading (GPS seconds, metres, degrees; with sd_roll,sd_pitch,sd_heading where their accuracy is known), Applanix SBET (with its smrmsg file beside it), or a point layer with these fields.</source>
        <translation>車両の位置です。CSV time,x,y,z,roll,pitch,heading（GPS秒、m、度。精度が分かる場合はsd_roll,sd_pitch,sd_headingも）、Applanix SBET（smrmsgファイルを同じ場所に置く）、またはこれらのフィールドを持つ点レイヤを指定します。</translation>
    </message>
    <message>
        <source>Kerbs or road edges</source>
        <translation>縁石線または道路縁</translation>
    </message>
    <message>
        <source>Instead of buildings: lines of a map on which the kerbs that the survey saw are laid, across the line; “Features” counts them as walls. By how much the lines are off is found.</source>
        <translation>建物の代わりに使います。計測に写った縁石を、地図の線に直交する方向で重ねます。「地物」では壁として扱います。線のずれは推定します。</translation>
    </message>
    <message>
        <source>Survey with its facades</source>
        <translation>壁面を含む計測点群</translation>
    </message>
    <message>
        <source>All points of the survey, where “Point clouds” holds its markings alone.</source>
        <translation>「点群」が標示だけのとき、計測の全点。</translation>
    </message>
    <message>
        <source>Heights of the ground in metres, in the height system of the survey. With it the correction is in space.</source>
        <translation>計測データと同じ高さの基準での地表の標高（m）です。指定すると3次元で補正します。</translation>
    </message>
    <message>
        <source>Patch length</source>
        <translation>パッチ長</translation>
    </message>
    <message>
        <source>Length of path that counts as rigid.</source>
        <translation>剛体とみなす経路の長さです。</translation>
    </message>
    <message>
        <source>Minimum window length</source>
        <translation>ウィンドウの最小長</translation>
    </message>
    <message>
        <source>patches</source>
        <translation>パッチ</translation>
    </message>
    <message>
        <source>Patches of the shortest window. By default 60; 30 with the paper's method in space.</source>
        <translation>最も短いウィンドウのパッチ数です。既定値は60、論文の方法による3次元補正では30です。</translation>
    </message>
    <message>
        <source>Maximum window length</source>
        <translation>ウィンドウの最大長</translation>
    </message>
    <message>
        <source>Patches of the longest window, which is used as it is even where it has too few markings. By default 200; no limit with the paper's method.</source>
        <translation>最も長いウィンドウのパッチ数です。路面標示が足りない所でもこの長さのまま使います。既定値は200、論文の方法では無制限です。</translation>
    </message>
    <message>
        <source>Feature grid</source>
        <translation>特徴グリッド</translation>
    </message>
    <message>
        <source>Side of the cells in which markings are counted.</source>
        <translation>路面標示を数えるセルの一辺です。</translation>
    </message>
    <message>
        <source>Feature count</source>
        <translation>特徴セル数</translation>
    </message>
    <message>
        <source>cells</source>
        <translation>セル</translation>
    </message>
    <message>
        <source>Cells with markings that a window should have. In space the paper's method counts marking points instead, 5 for each of these cells.</source>
        <translation>ウィンドウに必要な、路面標示のあるセルの数です。論文の方法による3次元補正では、代わりに路面標示点を、1セルにつき5点として数えます。</translation>
    </message>
    <message>
        <source>NDT grid</source>
        <translation>NDTグリッド</translation>
    </message>
    <message>
        <source>Side of the cells of the normal distributions.</source>
        <translation>正規分布を求めるセルの一辺です。</translation>
    </message>
    <message>
        <source>Iterations</source>
        <translation>反復回数</translation>
    </message>
    <message>
        <source>Most steps of each adjustment.</source>
        <translation>各調整計算の最大反復回数です。</translation>
    </message>
    <message>
        <source>Subsampling</source>
        <translation>間引き</translation>
    </message>
    <message>
        <source>One point is used in each cell of this side. By default 0.1 m; 0.3 m with the paper's method.</source>
        <translation>この一辺のセルごとに1点を使います。既定値は0.1 m、論文の方法では0.3 mです。</translation>
    </message>
    <message>
        <source>How far off the survey may be in plan. Where the best place lies at the edge of it, or hardly beats others, twice as far is looked at. Wider than half the distance between dashes invites a slip by one dash.</source>
        <translation>計測データの水平位置のずれの最大値です。最良の位置がその端にある場合や、他の位置との差がわずかな場合は、2倍の範囲まで調べます。破線の間隔の半分より広くすると、破線1本分ずれるおそれがあります。</translation>
    </message>
    <message>
        <source>full method</source>
        <translation>標準の方法</translation>
    </message>
    <message>
        <source>Full, or as in the paper to the letter: windows as rigid bodies, each started from the one before, and each patch moved by the matrix of its own window; no model of the drift, no weights, no bridging. In plan as in 3.2.4, with ground heights as in chapter 4. The markings of a whole survey are found by the paper's threshold. (full, paper)</source>
        <translation>full：全機能を使います。paper：論文どおりで、ウィンドウを剛体とし、それぞれ直前のウィンドウの結果から始め、各パッチを自身のウィンドウの行列で動かします。ドリフトのモデル、重み、補間はありません。平面では3.2.4節、地表の標高がある場合は4章によります。計測点群をそのまま入力した場合、標示は論文のしきい値で抽出します。（full, paper）</translation>
    </message>
    <message>
        <source>Accuracy of the reference</source>
        <translation>基準の精度</translation>
    </message>
    <message>
        <source>Standard deviation of the error that all reference markings around a place share (orientation of the frames, for example): no survey can show it, so that it is part of every standard deviation. The default holds where the reference counts as true; otherwise give what control points say of it.</source>
        <translation>ある場所の周囲の基準の路面標示すべてに共通する誤差（写真の標定など）の標準偏差です。計測データからは分からないため、すべての標準偏差に含めます。既定値は基準を真とみなす場合の値です。それ以外の場合は、検証点から得られた値を指定してください。</translation>
    </message>
    <message>
        <source>Accuracy of the ground</source>
        <translation>地表の精度</translation>
    </message>
    <message>
        <source>Standard deviation of the errors that neighbouring heights of the ground share; they must not turn the vehicle. By default found from how the ground bends against the survey.</source>
        <translation>隣り合う地表の標高に共通する誤差の標準偏差です。この誤差で車両の姿勢が変わらないようにします。既定では、計測データに対する地表の曲がりから求めます。</translation>
    </message>
    <message>
        <source>Accuracy of roll and pitch</source>
        <translation>ロール・ピッチの精度</translation>
    </message>
    <message>
        <source>Standard deviation of the reported roll and pitch; that of the heading is twice as large. Not used where the trajectory states its own (columns sd_roll, sd_pitch, sd_heading, or the smrmsg file beside an SBET).</source>
        <translation>補正前のrollとpitchの標準偏差です。方位の標準偏差はその2倍とします。軌跡自体が精度を持つ場合（sd_roll、sd_pitch、sd_headingの列、またはSBETと同じ場所のsmrmsgファイル）は使いません。</translation>
    </message>
    <message>
        <source>Maximum trusted standard deviation</source>
        <translation>信頼できる標準偏差の上限</translation>
    </message>
    <message>
        <source>A patch whose standard deviation in plan is larger is not to be trusted.</source>
        <translation>水平位置の標準偏差がこれより大きいパッチは信頼できないとします。</translation>
    </message>
    <message>
        <source>Aerial image</source>
        <translation>空中写真画像</translation>
    </message>
    <message>
        <source>Shown behind the markings in the report.</source>
        <translation>報告書で路面標示の背景に表示します。</translation>
    </message>
    <message>
        <source>Patches</source>
        <translation>パッチ</translation>
    </message>
    <message>
        <source>One point a patch at its corrected place, with correction (m, degrees), standard deviations (absolute with REFERENCE_SIGMA and what steps of the reference too small to be told add; sigma_relative without both), window, score, status and its reason; with walls the share of each witness (paint, walls).</source>
        <translation>パッチごとに補正後の位置に置いた点。補正量（m、度）、標準偏差（REFERENCE_SIGMA と検出できない基準の段差を含む絶対値。sigma_relative はどちらも含まない）、窓、スコア、状態とその理由。壁を使う場合は各証拠の割合（paint、walls）。</translation>
    </message>
    <message>
        <source>Disagreements</source>
        <translation>不一致箇所</translation>
    </message>
    <message>
        <source>One point a place where reference and survey disagree: edges of markings that changed after the flight, a reference that jumps, steps hidden where there are no markings, stretches where walls want the survey elsewhere than the markings; with size (m), direction (degrees from north) and standard deviation.</source>
        <translation>基準と計測が一致しない箇所ごとに1点：撮影後に変化した標示の端、基準の段差、標示のない区間に隠れた段差、壁面の示す位置が標示と異なる区間。大きさ（m）、方向（北からの度）、標準偏差付き。</translation>
    </message>
    <message>
        <source>Areas of disagreement</source>
        <translation>不一致の範囲</translation>
    </message>
    <message>
        <source>One polygon a stretch of road in which reference and survey disagree, as wide as its markings: markings that changed after the flight, the road about a step of which nobody can say the right side, stretches where a step hides or walls want the survey elsewhere; with chainages (m), size (m), direction (degrees from north) and standard deviation.</source>
        <translation>基準と計測成果が一致しない道路区間ごとのポリゴン。幅はその区間の標示の広がりです。撮影後に変わった標示、どちら側が正しいか判断できないずれの前後、標示のない所に隠れたずれ、壁面と標示が異なる位置を示す区間を含みます。属性は追加距離（m）、大きさ（m）、方向（北からの度）、標準偏差です。</translation>
    </message>
    <message>
        <source>Correction and its uncertainty along the path, pictures before and after, what to distrust.</source>
        <translation>経路に沿った補正量とその不確かさ、補正前後の図、信頼できない箇所を示します。</translation>
    </message>
    <message>
        <source>Length of the driven path.</source>
        <translation>走行経路の長さです。</translation>
    </message>
    <message>
        <source>Path length</source>
        <translation>経路長</translation>
    </message>
    <message>
        <source>In plan, over the path.</source>
        <translation>経路全体の水平位置についての値です。</translation>
    </message>
    <message>
        <source>Mean correction</source>
        <translation>平均補正量</translation>
    </message>
    <message>
        <source>In plan.</source>
        <translation>水平位置についての値です。</translation>
    </message>
    <message>
        <source>Maximum correction</source>
        <translation>最大補正量</translation>
    </message>
    <message>
        <source>Share of the path that is registered, 0 to 1.</source>
        <translation>経路のうち位置合わせ済みの割合（0～1）です。</translation>
    </message>
    <message>
        <source>Registered</source>
        <translation>位置合わせ済み</translation>
    </message>
    <message>
        <source>Share of the path that is bridged, 0 to 1.</source>
        <translation>経路のうち補間の割合（0～1）です。</translation>
    </message>
    <message>
        <source>Bridged</source>
        <translation>補間</translation>
    </message>
    <message>
        <source>Share of the path not to be trusted, 0 to 1.</source>
        <translation>経路のうち信頼できない割合（0～1）です。</translation>
    </message>
    <message>
        <source>Not to be trusted</source>
        <translation>信頼できない区間</translation>
    </message>
    <message>
        <source>In plan, over the whole path.</source>
        <translation>水平位置、全経路。</translation>
    </message>
    <message>
        <source>Maximum standard deviation</source>
        <translation>標準偏差の最大値</translation>
    </message>
    <message>
        <source>Register mobile survey</source>
        <translation>MMS計測の位置合わせ</translation>
    </message>
    <message>
        <source>The survey: LAS, LAZ or COPC files with intensities and GPS times, in one projected coordinate system.</source>
        <translation>計測データです。反射強度とGPS時刻を持ち、同じ投影座標系のLAS、LAZまたはCOPCファイルを指定します。</translation>
    </message>
    <message>
        <source>Maximum range</source>
        <translation>最大距離</translation>
    </message>
    <message>
        <source>Points farther from the scanner, in metres, are left out. The range up to which the curve holds (R2) may be shorter.</source>
        <translation>スキャナからこれより遠い点（m）を除きます。補正曲線が有効な距離（R2）はこれより短いことがあります。</translation>
    </message>
    <message>
        <source>Side in metres of the block whose mean a marking exceeds.</source>
        <translation>路面標示の判定で平均をとるブロックの一辺（m）です。路面標示はこの平均より明るいものです。</translation>
    </message>
    <message>
        <source>Full, or as in the paper to the letter: the adaptive threshold of block and grey contrast alone, on an image of 12 cm; contrast, stroke width and length do not count then, and kerbs, feet of walls and specks stay. (full, paper)</source>
        <translation>full：全機能を使います。paper：論文どおりで、12 cmの画像にブロックとグレーコントラストによる適応的閾値処理だけを行います。この場合、コントラスト、線の幅、長さは無効で、縁石、壁の根元、小さな斑点も残ります。（full, paper）</translation>
    </message>
    <message>
        <source>Grey contrast</source>
        <translation>グレーコントラスト</translation>
    </message>
    <message>
        <source>With the paper's method: by how many grey levels of 256 a marking exceeds the weighted mean of its block (c). White is the intensity that 0.1 % of the ground exceeds.</source>
        <translation>論文の方法で、路面標示がブロックの加重平均を上回る階調値（256階調、c）です。白は、地表面の0.1 %がそれを超える反射強度です。</translation>
    </message>
    <message>
        <source>How much brighter than the ground a marking is, as a share of the ground's intensity.</source>
        <translation>路面標示が地面よりどれだけ明るいかを、地面の反射強度に対する割合で指定します。</translation>
    </message>
    <message>
        <source>What is wider in both directions, in metres, is no marking but ground.</source>
        <translation>両方向ともこれより広いもの（m）は、路面標示ではなく地面とみなします。</translation>
    </message>
    <message>
        <source>Minimum length</source>
        <translation>最小長</translation>
    </message>
    <message>
        <source>Shorter pieces, in metres, are left out.</source>
        <translation>これより短いもの（m）は除きます。</translation>
    </message>
    <message>
        <source>Marking points</source>
        <translation>路面標示点</translation>
    </message>
    <message>
        <source>Points on markings with all their attributes, and calibrated_intensity (asphalt has the reference intensity) and marking_weight (0 to 1: how far above the middle between ground and paint).</source>
        <translation>路面標示上の点です。すべての属性に加え、calibrated_intensity（アスファルトが基準の反射強度になるよう補正した値）とmarking_weight（0～1、地面と標示の中間をどれだけ上回るか）を持ちます。</translation>
    </message>
    <message>
        <source>Intensity over range</source>
        <translation>距離と反射強度の関係</translation>
    </message>
    <message>
        <source>Page with plot, table and quality of the fit of each scanner.</source>
        <translation>スキャナごとの図、表、当てはめの品質を示すページです。</translation>
    </message>
    <message>
        <source>Ground points within range of the vehicle.</source>
        <translation>車両から距離の範囲内にある地表面点の数です。</translation>
    </message>
    <message>
        <source>Points in the result.</source>
        <translation>結果の点の数です。</translation>
    </message>
    <message>
        <source>Marking points as a share of the ground points that could be judged, 0 to 1.</source>
        <translation>判定できた地表面点のうち路面標示点の割合（0～1）です。</translation>
    </message>
    <message>
        <source>Marking share</source>
        <translation>路面標示の割合</translation>
    </message>
    <message>
        <source>Median intensity of marking points, in units of that of the ground beside them; no value without markings.</source>
        <translation>路面標示点の反射強度の中央値を、隣接する地面の反射強度を単位として表したものです。路面標示がない場合は値がありません。</translation>
    </message>
    <message>
        <source>Contrast of paint</source>
        <translation>標示のコントラスト</translation>
    </message>
    <message>
        <source>By how much asphalt in bins of range departs from the curve, as a share of it (robust standard deviation; worst scanner).</source>
        <translation>距離区分ごとのアスファルトの反射強度と曲線との差を、曲線に対する割合で表したものです（ロバスト標準偏差、最も悪いスキャナ）。</translation>
    </message>
    <message>
        <source>Residual of the fit</source>
        <translation>当てはめの残差</translation>
    </message>
    <message>
        <source>Standard deviation of single asphalt points round the curve, as a share of it (of the same scanner).</source>
        <translation>曲線のまわりのアスファルトの個々の点の標準偏差を、曲線に対する割合で表したものです（同じスキャナ）。</translation>
    </message>
    <message>
        <source>Scatter of asphalt</source>
        <translation>アスファルトのばらつき</translation>
    </message>
    <message>
        <source>Scanners with a curve.</source>
        <translation>曲線が得られたスキャナの数です。</translation>
    </message>
    <message>
        <source>Scanners</source>
        <translation>スキャナ</translation>
    </message>
    <message>
        <source>R2: range up to which points are used.</source>
        <translation>R2：使用する点の最大距離です。</translation>
    </message>
    <message>
        <source>Maximum range used</source>
        <translation>使用した最大距離</translation>
    </message>
    <message>
        <source>Share of the path, by 20 m, with marking points, 0 to 1.</source>
        <translation>経路を20 mごとに区切ったとき、路面標示点のある割合（0～1）です。</translation>
    </message>
    <message>
        <source>Path with markings</source>
        <translation>路面標示のある経路</translation>
    </message>
    <message>
        <source>Points at times for which the trajectory has no place, or at which the vehicle stood.</source>
        <translation>軌跡に位置がない時刻の点、または停車中の点の数です。</translation>
    </message>
    <message>
        <source>Points left out</source>
        <translation>除いた点</translation>
    </message>
    <message>
        <source>Road markings of a mobile survey</source>
        <translation>MMS計測の路面標示</translation>
    </message>
    <message>
        <source>Line images</source>
        <translation>ライン画像</translation>
    </message>
    <message>
        <source>Strip images of line cameras, one column a time, each with the table of its columns' times beside it (column,time).</source>
        <translation>ラインカメラのストリップ画像です。1列が1時刻にあたります。それぞれ、列の時刻の表（column,time）を同じ場所に置きます。</translation>
    </message>
    <message>
        <source>Perspective images, each named in the exterior orientation.</source>
        <translation>中心投影の画像です。それぞれの名称が外部標定要素にある必要があります。</translation>
    </message>
    <message>
        <source>JSON file of the frames' camera.</source>
        <translation>写真のカメラのJSONファイルです。</translation>
    </message>
    <message>
        <source>CSV file image,x,y,z,omega,phi,kappa of the frames, or what Metashape or Pix4D wrote.</source>
        <translation>写真の CSV ファイル image,x,y,z,omega,phi,kappa、または Metashape か Pix4D が出力したファイル。</translation>
    </message>
    <message>
        <source>Building models</source>
        <translation>建物モデル</translation>
    </message>
    <message>
        <source>MultiPolygonZ with all faces of each building, such as those of “Building models”; the field building_id names them.</source>
        <translation>「建物モデル」の出力など、建物ごとにすべての面を持つMultiPolygonZです。フィールドbuilding_idで識別します。</translation>
    </message>
    <message>
        <source>Laser points</source>
        <translation>レーザ点</translation>
    </message>
    <message>
        <source>Points of the survey; what stands before a facade hides it.</source>
        <translation>計測データの点です。壁面の手前にある物は壁面を隠します。</translation>
    </message>
    <message>
        <source>Side of a pixel on the facade.</source>
        <translation>壁面上での画素の一辺です。</translation>
    </message>
    <message>
        <source>Line images are used up to this distance.</source>
        <translation>この距離までのライン画像を使います。</translation>
    </message>
    <message>
        <source>Minimum share seen</source>
        <translation>可視割合の下限</translation>
    </message>
    <message>
        <source>Facades of which images show less get no texture.</source>
        <translation>画像に写る割合がこれより小さい壁面にはテクスチャを付けません。</translation>
    </message>
    <message>
        <source>Textured model</source>
        <translation>テクスチャ付きモデル</translation>
    </message>
    <message>
        <source>glTF binary (*.glb);;Wavefront OBJ (*.obj);;CityJSON (*.city.json *.json)</source>
        <translation>glTFバイナリ (*.glb);;Wavefront OBJ (*.obj);;CityJSON (*.city.json *.json)</translation>
    </message>
    <message>
        <source>By its ending: .glb holds its images; .obj and .city.json have theirs in a folder beside.</source>
        <translation>形式は拡張子で決まります。.glbは画像を内部に持ち、.objと.city.jsonは同じ場所のフォルダに持ちます。</translation>
    </message>
    <message>
        <source>Folder of all kinds</source>
        <translation>全形式のフォルダ</translation>
    </message>
    <message>
        <source>The model as glTF, OBJ and CityJSON with its images.</source>
        <translation>glTF、OBJ、CityJSONのモデルとその画像です。</translation>
    </message>
    <message>
        <source>Facades</source>
        <translation>壁面</translation>
    </message>
    <message>
        <source>PolygonZ, one feature a facade: building_id, facade, area (m2), azimuth (degrees), seen (share), detail (m, size of the images' pixels), images, status, reason.</source>
        <translation>壁面ごとに1地物のPolygonZです：building_id、facade、area（m2）、azimuth（度）、seen（割合）、detail（m、画像の画素の大きさ）、images、status、reason。</translation>
    </message>
    <message>
        <source>Number of facades.</source>
        <translation>壁面の数です。</translation>
    </message>
    <message>
        <source>Facades with a texture.</source>
        <translation>テクスチャのある壁面の数です。</translation>
    </message>
    <message>
        <source>Textured facades</source>
        <translation>テクスチャ付きの壁面</translation>
    </message>
    <message>
        <source>Share of all facades' area that images show, 0 to 1.</source>
        <translation>全壁面の面積のうち画像に写る割合（0～1）です。</translation>
    </message>
    <message>
        <source>Share seen</source>
        <translation>可視の割合</translation>
    </message>
    <message>
        <source>Range scans</source>
        <translation>測距スキャン</translation>
    </message>
    <message>
        <source>One or several tables of time, angle, range, intensity and scanner (CSV, CSV.GZ, Parquet, LAS, LAZ).</source>
        <translation>時刻、角度、距離、反射強度、スキャナの1つまたは複数の表です（CSV、CSV.GZ、Parquet、LAS、LAZ）。</translation>
    </message>
    <message>
        <source>Range scans (*.csv *.csv.gz *.parquet *.las *.laz)</source>
        <translation>レンジスキャン (*.csv *.csv.gz *.parquet *.las *.laz)</translation>
    </message>
    <message>
        <source>Of the trajectory, where its layer does not say it; it is written into the point cloud, and needed for SBET trajectories.</source>
        <translation>レイヤに記載がない場合の軌跡の座標参照系です。点群に書き込まれ、SBETの軌跡では必須です。</translation>
    </message>
    <message>
        <source>Returns from farther away, in metres, are left out; 0 takes each scanner's own limit from the calibration.</source>
        <translation>これより遠い反射（m）を除きます。0の場合は、校正値にある各スキャナの上限を使います。</translation>
    </message>
    <message>
        <source>Minimum range</source>
        <translation>最小距離</translation>
    </message>
    <message>
        <source>Nearer returns, in metres, are left out, such as those of the vehicle itself.</source>
        <translation>車両自体からの反射など、これより近い反射（m）を除きます。</translation>
    </message>
    <message>
        <source>Unit of the angles in the file. (degrees, radians)</source>
        <translation>ファイル中の角度の単位です。（degrees, radians）</translation>
    </message>
    <message>
        <source>Point cloud</source>
        <translation>点群</translation>
    </message>
    <message>
        <source>Points with gps_time, intensity, point_source_id, angle and range.</source>
        <translation>gps_time、intensity、point_source_id、角度、距離を持つ点です。</translation>
    </message>
    <message>
        <source>Returns in the file.</source>
        <translation>ファイル中の反射の数です。</translation>
    </message>
    <message>
        <source>Returns</source>
        <translation>反射</translation>
    </message>
    <message>
        <source>Returns left out for want of a range or angle.</source>
        <translation>距離または角度がないため除いた反射の数です。</translation>
    </message>
    <message>
        <source>Without a range</source>
        <translation>距離なし</translation>
    </message>
    <message>
        <source>Returns left out because they are too near or far.</source>
        <translation>近すぎる、または遠すぎるため除いた反射の数です。</translation>
    </message>
    <message>
        <source>Beyond the range</source>
        <translation>距離の範囲外</translation>
    </message>
    <message>
        <source>Returns left out because they were measured outside the trajectory or in a gap of it.</source>
        <translation>軌跡の時間外または欠測区間で計測されたため除いた反射の数です。</translation>
    </message>
    <message>
        <source>Outside the time</source>
        <translation>時間外</translation>
    </message>
    <message>
        <source>Laser points of the survey, LAS, LAZ or COPC, placed by the same trajectory.</source>
        <translation>同じ軌跡で座標付けされた計測データのレーザ点（LAS、LAZまたはCOPC）です。</translation>
    </message>
    <message>
        <source>Outlines</source>
        <translation>外周線</translation>
    </message>
    <message>
        <source>Polygons, lines or points drawn on the images, in pixels.</source>
        <translation>画像上に描いたポリゴン、線または点です（画素座標）。</translation>
    </message>
    <message>
        <source>Laser points farther from the camera are not used (line images).</source>
        <translation>カメラからこれより遠いレーザ点は使いません（ライン画像）。</translation>
    </message>
    <message>
        <source>Objects</source>
        <translation>地物</translation>
    </message>
    <message>
        <source>One feature an outline, with z: the fields of the outlines and width, height (m), azimuth (degrees, where the surface faces), area (m2), z_low, z_high, distance (m, from the camera), points, rmse, sigma (m), status, reason.</source>
        <translation>外周線ごとに1地物で、zを持ちます：外周線のフィールドと、width、height（m）、azimuth（度、面の向き）、area（m2）、z_low、z_high、distance（m、カメラから）、points、rmse、sigma（m）、status、reason。</translation>
    </message>
    <message>
        <source>Number of outlines.</source>
        <translation>外周線の数です。</translation>
    </message>
    <message>
        <source>Outlines that became features with a place.</source>
        <translation>位置の決まった地物になった外周線の数です。</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>計測できた外周線</translation>
    </message>
    <message>
        <source>Median standard deviation of the corners' places against the laser points.</source>
        <translation>レーザ点に対する角の位置の標準偏差の中央値です。</translation>
    </message>
    <message>
        <source>Median sigma</source>
        <translation>σの中央値</translation>
    </message>
    <message>
        <source>Image of the map, in the CRS of points and lines.</source>
        <translation>点と線の座標参照系での地図画像です。</translation>
    </message>
    <message>
        <source>Laser points to draw, LAS, LAZ or COPC.</source>
        <translation>描画するレーザ点（LAS、LAZまたはCOPC）です。</translation>
    </message>
    <message>
        <source>Models or lines</source>
        <translation>モデルまたは線</translation>
    </message>
    <message>
        <source>Building models (MultiPolygonZ with all faces) or lines with heights; their edges are drawn.</source>
        <translation>建物モデル（すべての面を持つMultiPolygonZ）または高さを持つ線です。その辺を描きます。</translation>
    </message>
    <message>
        <source>Colour points by</source>
        <translation>点の色分け</translation>
    </message>
    <message>
        <source>height of the point</source>
        <translation>点の高さ</translation>
    </message>
    <message>
        <source>intensity</source>
        <translation>反射強度</translation>
    </message>
    <message>
        <source>class of the point</source>
        <translation>点のクラス</translation>
    </message>
    <message>
        <source>one colour</source>
        <translation>単色</translation>
    </message>
    <message>
        <source>What the colours of points tell (height, intensity, class, one)</source>
        <translation>点の色が表す内容です。（height, intensity, class, one）</translation>
    </message>
    <message>
        <source>Laser points before</source>
        <translation>補正前のレーザ点</translation>
    </message>
    <message>
        <source>The same points before a correction.</source>
        <translation>補正前の同じ点です。</translation>
    </message>
    <message>
        <source>Models or lines before</source>
        <translation>補正前のモデルまたは線</translation>
    </message>
    <message>
        <source>The same models or lines before a correction.</source>
        <translation>補正前の同じモデルまたは線です。</translation>
    </message>
    <message>
        <source>Trajectory before</source>
        <translation>補正前の軌跡</translation>
    </message>
    <message>
        <source>Line images show things up to this distance.</source>
        <translation>ライン画像に写る物を描く最大距離です。</translation>
    </message>
    <message>
        <source>Pictures on the page</source>
        <translation>ページの図の数</translation>
    </message>
    <message>
        <source>At most so many; the fullest windows are taken.</source>
        <translation>最大数です。描かれる物の最も多い範囲から選びます。</translation>
    </message>
    <message>
        <source>Folder of images</source>
        <translation>画像のフォルダ</translation>
    </message>
    <message>
        <source>Each image with the overlay as JPEG, and the pictures of the page before and after beside each other.</source>
        <translation>重ね描きした各画像のJPEGと、ページ用の補正前後を並べた図です。</translation>
    </message>
    <message>
        <source>Page</source>
        <translation>ページ</translation>
    </message>
    <message>
        <source>Page that switches between plain image, before and after.</source>
        <translation>元の画像、補正前、補正後を切り替えて表示するページです。</translation>
    </message>
    <message>
        <source>Images in which points or edges lie.</source>
        <translation>点または辺がある画像の数です。</translation>
    </message>
    <message>
        <source>Images drawn on</source>
        <translation>描画した画像</translation>
    </message>
    <message>
        <source>Images in which nothing lies.</source>
        <translation>何もない画像の数です。</translation>
    </message>
    <message>
        <source>Images without</source>
        <translation>描画のない画像</translation>
    </message>
    <message>
        <source>Overlay on images</source>
        <translation>画像への重ね描き</translation>
    </message>
    <message>
        <source>The reported trajectory: CSV time,x,y,z,roll,pitch,heading (GPS seconds, metres, degrees), Applanix SBET, or a point layer with these fields.</source>
        <translation>補正前の軌跡です。CSV time,x,y,z,roll,pitch,heading（GPS秒、m、度）、Applanix SBET、またはこれらのフィールドを持つ点レイヤを指定します。</translation>
    </message>
    <message>
        <source>Tie points</source>
        <translation>タイポイント</translation>
    </message>
    <message>
        <source>CSV or layer with set,time,x_mms,y_mms,x_ref,y_ref: name of the set, when the survey measured the place (s), where it lies in the survey and in the reference (m). In a line layer with set and time each line may run from survey to reference instead.</source>
        <translation>set,time,x_mms,y_mms,x_ref,y_ref（組の名称、計測時刻（s）、計測データ上と基準上の位置（m））を持つCSVまたはレイヤです。setとtimeを持つ線レイヤでは、代わりに各線を計測データから基準へ引いてもかまいません。</translation>
    </message>
    <message>
        <source>Heights of the ground, or a surface, along the course: then heights are corrected too.</source>
        <translation>走行軌跡に沿う地表または表層の標高です。指定すると高さも補正します。</translation>
    </message>
    <message>
        <source>Height of the origin</source>
        <translation>原点の高さ</translation>
    </message>
    <message>
        <source>Height of the trajectory's origin above the ground, in metres. Without it the mean height stays as reported.</source>
        <translation>地表から軌跡の原点までの高さ（m）です。指定しない場合、平均の高さは補正前のままです。</translation>
    </message>
    <message>
        <source>best estimate of the drift</source>
        <translation>ドリフトの最良推定</translation>
    </message>
    <message>
        <source>Best estimate of the drift from all tie points; or the paper to the letter. (drift, paper)</source>
        <translation>drift：すべてのタイポイントによるドリフトの最適推定。paper：全体を論文どおりに実行。（drift, paper）</translation>
    </message>
    <message>
        <source>Sigma of tie points</source>
        <translation>タイポイントのσ</translation>
    </message>
    <message>
        <source>Standard deviation of a tie point's coordinate in metres; 0 finds it from the tie points.</source>
        <translation>タイポイントの座標の標準偏差（m）です。0の場合はタイポイントから求めます。</translation>
    </message>
    <message>
        <source>Expected error of the heading</source>
        <translation>方位の予想誤差</translation>
    </message>
    <message>
        <source>Standard deviation in degrees: what is known of the heading where the pairs of a set lie close together.</source>
        <translation>標準偏差（度）です。組の中の対応点が互いに近い場合の、方位に関する既知の精度です。</translation>
    </message>
    <message>
        <source>Keep doubtful sets</source>
        <translation>疑わしい組の使用</translation>
    </message>
    <message>
        <source>Use sets even though the other sets put them elsewhere.</source>
        <translation>他の組と位置が合わない組も使います。</translation>
    </message>
    <message>
        <source>Of trajectory and tie points, where no layer says it; needed for SBET trajectories.</source>
        <translation>レイヤに記載がない場合の、軌跡とタイポイントの座標参照系です。SBETの軌跡では必須です。</translation>
    </message>
    <message>
        <source>Line images for the report</source>
        <translation>報告書用のライン画像</translation>
    </message>
    <message>
        <source>Strip images of line cameras: the report shows the models or lines over them, before and after.</source>
        <translation>ラインカメラのストリップ画像です。報告書に、モデルまたは線を補正前後で重ねて表示します。</translation>
    </message>
    <message>
        <source>Models or lines for the report</source>
        <translation>報告書用のモデルまたは線</translation>
    </message>
    <message>
        <source>Building models (MultiPolygonZ) or lines with heights, drawn over the line images.</source>
        <translation>ライン画像に重ねて描く建物モデル（MultiPolygonZ）または高さを持つ線です。</translation>
    </message>
    <message>
        <source>Rectified trajectory</source>
        <translation>補正後の軌跡</translation>
    </message>
    <message>
        <source>Sets</source>
        <translation>対応点の組</translation>
    </message>
    <message>
        <source>One point a set: distance from the reference before and after, correction, misfit within the set, how far off it would lie without itself (predicted), and its status.</source>
        <translation>組ごとに1点です。補正前後の基準との距離、補正量、組内の不符合値、その組を使わない場合のずれ（predicted）、状態を持ちます。</translation>
    </message>
    <message>
        <source>Epochs</source>
        <translation>エポック</translation>
    </message>
    <message>
        <source>One point an epoch: correction, sigma and status (between sets, or carried on (extrapolated) before the first or after the last).</source>
        <translation>エポックごとに1点です。補正量、σ、状態（組の間、または最初の組の前・最後の組の後の外挿（extrapolated））を持ちます。</translation>
    </message>
    <message>
        <source>Before and after, set by set, as HTML.</source>
        <translation>組ごとの補正前後の比較をHTMLで示します。</translation>
    </message>
    <message>
        <source>Sets of tie points within the trajectory's time.</source>
        <translation>軌跡の時間内にあるタイポイントの組の数です。</translation>
    </message>
    <message>
        <source>Sets that were not left out.</source>
        <translation>除かれなかった組の数です。</translation>
    </message>
    <message>
        <source>Sets used</source>
        <translation>使用した組</translation>
    </message>
    <message>
        <source>Mean distance of the tie points from the reference as reported.</source>
        <translation>補正前のタイポイントと基準との平均距離です。</translation>
    </message>
    <message>
        <source>Distance before</source>
        <translation>補正前の距離</translation>
    </message>
    <message>
        <source>The same after the rectification.</source>
        <translation>補正後の同様の値です。</translation>
    </message>
    <message>
        <source>Distance after</source>
        <translation>補正後の距離</translation>
    </message>
    <message>
        <source>Mean over the sets of how far a set would lie off if it were not used.</source>
        <translation>ある組を使わない場合にその組がどれだけずれるかの、全組の平均です。</translation>
    </message>
    <message>
        <source>Off without itself</source>
        <translation>一つ抜き残差</translation>
    </message>
    <message>
        <source>Mean standard deviation of a plan coordinate between the sets.</source>
        <translation>組の間の平面座標の標準偏差の平均です。</translation>
    </message>
    <message>
        <source>Mean sigma</source>
        <translation>σの平均</translation>
    </message>
    <message>
        <source>Largest of all epochs.</source>
        <translation>全エポックの最大値です。</translation>
    </message>
    <message>
        <source>Maximum sigma</source>
        <translation>σの最大値</translation>
    </message>
    <message>
        <source>Share of the epochs before the first or after the last set, 0 to 1.</source>
        <translation>エポックのうち、最初の組の前または最後の組の後の割合（0～1）です。</translation>
    </message>
    <message>
        <source>Share extrapolated</source>
        <translation>外挿の割合</translation>
    </message>
    <message>
        <source>Root mean square distance from the ground as reported; no value without a ground.</source>
        <translation>補正前の地表との高さの差の二乗平均平方根です。地表がない場合は値がありません。</translation>
    </message>
    <message>
        <source>Height before</source>
        <translation>補正前の高さの差</translation>
    </message>
    <message>
        <source>Height after</source>
        <translation>補正後の高さの差</translation>
    </message>
    <message>
        <source>Rectify trajectory</source>
        <translation>軌跡の補正</translation>
    </message>
    <message>
        <source>The survey, placed with the trajectory: one or several LAS, LAZ or COPC files with GPS times.</source>
        <translation>軌跡で座標付けされた計測データです。GPS時刻を持つ1つまたは複数のLAS、LAZまたはCOPCファイルを指定します。</translation>
    </message>
    <message>
        <source>Outlines of the walls in the survey's coordinate system. Without them give a surface.</source>
        <translation>計測データと同じ座標系の、壁面の外周線。ない場合は表層を指定します。</translation>
    </message>
    <message>
        <source>Heights of a surface model (DSM) with its buildings, instead of outlines: cells of 0.5 m give corners to 0.1 m, of 1 m to 0.4 m.</source>
        <translation>外周線の代わりに使う、建物を含む表層モデル（DSM）の標高。角の精度は、グリッド間隔0.5 mで0.1 m、1 mで0.4 mほどです。</translation>
    </message>
    <message>
        <source>Maximum distance</source>
        <translation>最大距離</translation>
    </message>
    <message>
        <source>Corners farther from the course, in metres, are left out.</source>
        <translation>走行軌跡からこれより遠い角（m）を除きます。</translation>
    </message>
    <message>
        <source>Search range</source>
        <translation>探索範囲</translation>
    </message>
    <message>
        <source>How far survey and outlines may lie apart, in metres.</source>
        <translation>計測データと外周線のずれの最大値（m）です。</translation>
    </message>
    <message>
        <source>Agreement</source>
        <translation>一致の許容差</translation>
    </message>
    <message>
        <source>Shifts of neighbouring corners that differ by less, in metres, agree: as good as the outlines are.</source>
        <translation>隣り合う角のずれの差がこれ（m）より小さければ一致とみなします。外周線の精度に合わせます。</translation>
    </message>
    <message>
        <source>Lines from the survey to the reference with set, time (s), length (m), support (other corners shifted likewise) and fit of the walls (m).</source>
        <translation>計測データから基準への線です。set、time（s）、length（m）、support（同様にずれている他の角）、壁の当てはまり（m）を持ちます。</translation>
    </message>
    <message>
        <source>Corners of buildings near the course.</source>
        <translation>走行軌跡付近にある建物の角の数。</translation>
    </message>
    <message>
        <source>Corners</source>
        <translation>角</translation>
    </message>
    <message>
        <source>Corners that the survey shows.</source>
        <translation>計測データに現れた角の数です。</translation>
    </message>
    <message>
        <source>Corners found</source>
        <translation>検出した角</translation>
    </message>
    <message>
        <source>Sets of two tie points.</source>
        <translation>2つのタイポイントからなる組の数です。</translation>
    </message>
    <message>
        <source>Mean distance between survey and reference.</source>
        <translation>計測データと基準との平均距離です。</translation>
    </message>
    <message>
        <source>Mean length</source>
        <translation>平均長</translation>
    </message>
    <message>
        <source>Roof polygons</source>
        <translation>屋根ポリゴン</translation>
    </message>
    <message>
        <source>Polygons from “Roof polygons” with the fields building_id, roof_id and height (m).</source>
        <translation>「屋根ポリゴン」によるポリゴンです。フィールドbuilding_id、roof_id、height（m）を持ちます。</translation>
    </message>
    <message>
        <source>Outlines from “Segment buildings”. Each gets a row in the result. A field ground gives the height of the ground in metres.</source>
        <translation>「建物の抽出」による外周線です。それぞれが結果の1行になります。フィールドgroundは地表の標高（m）です。</translation>
    </message>
    <message>
        <source>Heights of the ground in metres; the lowest along an outline is the base of its walls.</source>
        <translation>地表の標高（m）です。外周線に沿う最低値を壁の下端とします。</translation>
    </message>
    <message>
        <source>Base height field</source>
        <translation>基準高のフィールド</translation>
    </message>
    <message>
        <source>Field of the buildings with the height of the base of the walls in metres; used where there is no ground elevation.</source>
        <translation>壁の下端の標高（m）を持つ建物のフィールドです。地表の標高がない場合に使います。</translation>
    </message>
    <message>
        <source>Roof points</source>
        <translation>屋根の点</translation>
    </message>
    <message>
        <source>Points with building_id and roof_id, from “Segment roofs”, for the figures of fit.</source>
        <translation>「屋根の分割」による、building_idとroof_idを持つ点です。当てはまりの数値を求めるのに使います。</translation>
    </message>
    <message>
        <source>Roofs</source>
        <translation>屋根</translation>
    </message>
    <message>
        <source>roof planes</source>
        <translation>屋根面（傾斜屋根を含む）</translation>
    </message>
    <message>
        <source>level roofs</source>
        <translation>水平な屋根</translation>
    </message>
    <message>
        <source>planes: roofs as the polygons' heights have them (LoD2.2 where any is sloped); levels: every roof at its one height (LoD1.3). (planes, levels)</source>
        <translation>planes：ポリゴンの高さどおりの屋根（傾斜屋根があればLoD2.2）。levels：すべての屋根をそれぞれ1つの高さとします（LoD1.3）。（planes, levels）</translation>
    </message>
    <message>
        <source>Text that the report shows with its settings, such as the name of the project.</source>
        <translation>報告書に設定とともに表示する文章です（業務名など）。</translation>
    </message>
    <message>
        <source>MultiPolygonZ, one feature a building with all faces of its solids; status, reason, roofs, base, height (m), area (m2), volume (m3), points, density (points a m2), rmse_z, rmse_z95, median_dz, rmse_3d, p95 (m), coverage, unseen, beyond (shares), lod, roof_type, not_explained (share of the points that can be roof and lie far from the model), quality (0 to 1), roof_min, roof_50, roof_70, roof_max (m above the ground), volume_lod12, volume_lod13, volume_lod22 (m3), area_roof_flat, area_roof_sloped (m2), storeys_estimated.</source>
        <translation>建物ごとに1地物で、立体のすべての面を持つMultiPolygonZです：status、reason、roofs、base、height（m）、area（m2）、volume（m3）、points、density（点/m2）、rmse_z、rmse_z95、median_dz、rmse_3d、p95（m）、coverage、unseen、beyond（割合）、lod、roof_type、not_explained（屋根でありうる点のうちモデルから遠いものの割合）、quality（0～1）、roof_min、roof_50、roof_70、roof_max（地表からのm）、volume_lod12、volume_lod13、volume_lod22（m3）、area_roof_flat、area_roof_sloped（m2）、storeys_estimated。</translation>
    </message>
    <message>
        <source>Surfaces</source>
        <translation>面</translation>
    </message>
    <message>
        <source>MultiPolygonZ, one feature a surface, with building_id, roof_id and surface_type: roof, outer wall, inner wall, ground; of roofs seen (share that the points have seen) and sigma (expected error of its height, m).</source>
        <translation>1地物が1面のMultiPolygonZです：building_id、roof_id、surface_type（roof、outer wall、inner wall、ground）。屋根にはseen（点が捉えた割合）とsigma（高さの予想誤差、m）があります。</translation>
    </message>
    <message>
        <source>CityJSON</source>
        <translation>CityJSON</translation>
    </message>
    <message>
        <source>CityJSON (*.city.json *.json)</source>
        <translation>CityJSON (*.city.json *.json)</translation>
    </message>
    <message>
        <source>CityJSON 2.0 file with outlines and solids at the levels of detail 0, 1.2, 1.3 and 2.2, surface types, the fields of the outlines and the figures of each building.</source>
        <translation>CityJSON 2.0ファイルです。外周線、詳細度0、1.2、1.3、2.2の立体、面の種別、外周線のフィールド、各建物の数値を持ちます。</translation>
    </message>
    <message>
        <source>Points with building_id from “Segment buildings”, or any points of airborne scanning.</source>
        <translation>「建物の抽出」によるbuilding_id付きの点、または航空レーザ測量の任意の点。</translation>
    </message>
    <message>
        <source>One feature a building, where it stands. A field ground gives the height of the ground in metres.</source>
        <translation>建物の位置に、建物ごとに1地物。フィールドgroundは地盤の標高（メートル）を示します。</translation>
    </message>
    <message>
        <source>Distance in metres from the mesh within which at least 95 % of a building's uppermost points shall lie.</source>
        <translation>建物の最上部の点の95 %以上が収まるべき、メッシュからの距離（メートル）です。</translation>
    </message>
    <message>
        <source>Heights of the ground in metres; the lowest along an outline is the foot of its walls.</source>
        <translation>地表の標高（メートル）。外周線に沿った最低値を壁面の下端とします。</translation>
    </message>
    <message>
        <source>Height step</source>
        <translation>段差の高さ</translation>
    </message>
    <message>
        <source>Steps of the roof higher than this, in metres, become upright walls.</source>
        <translation>これ（メートル）より高い屋根の段差を鉛直な壁面とします。</translation>
    </message>
    <message>
        <source>Minimum area of a surface</source>
        <translation>面の最小面積</translation>
    </message>
    <message>
        <source>Smaller pieces between steps become part of what is beside them.</source>
        <translation>段差に挟まれたこれより小さい部分は、隣の部分に併合されます。</translation>
    </message>
    <message>
        <source>Meshes</source>
        <translation>メッシュ</translation>
    </message>
    <message>
        <source>MultiPolygonZ, one feature a building with all triangles; status, reason, triangles, surfaces, base, height (m), points, rmse, p95, max_error (m), within (share of the uppermost points), watertight, valid.</source>
        <translation>MultiPolygonZ、建物ごとに1地物で全三角形を含みます: status、reason、triangles、surfaces、base、height（m）、points、rmse、p95、max_error（m）、within（最上部の点に占める割合）、watertight、valid。</translation>
    </message>
    <message>
        <source>OBJ mesh</source>
        <translation>OBJメッシュ</translation>
    </message>
    <message>
        <source>Wavefront OBJ (*.obj)</source>
        <translation>Wavefront OBJ (*.obj)</translation>
    </message>
    <message>
        <source>Wavefront OBJ file, a group for each building.</source>
        <translation>Wavefront OBJファイルです。建物ごとに1グループです。</translation>
    </message>
    <message>
        <source>PLY mesh</source>
        <translation>PLYメッシュ</translation>
    </message>
    <message>
        <source>All meshes in one binary PLY file, which QGIS opens as a mesh layer.</source>
        <translation>すべてのメッシュを1つのバイナリPLYファイルにまとめたもの。QGISではメッシュレイヤとして開けます。</translation>
    </message>
    <message>
        <source>Buildings with a mesh.</source>
        <translation>メッシュを作成した建物です。</translation>
    </message>
    <message>
        <source>Meshed</source>
        <translation>メッシュ作成済み</translation>
    </message>
    <message>
        <source>Meshes that are closed.</source>
        <translation>閉じたメッシュの数です。</translation>
    </message>
    <message>
        <source>Watertight</source>
        <translation>水密</translation>
    </message>
    <message>
        <source>Share of the uppermost points within the stated error.</source>
        <translation>最上部の点のうち、指定した誤差に収まるものの割合です。</translation>
    </message>
    <message>
        <source>Points within the error</source>
        <translation>誤差内の点</translation>
    </message>
    <message>
        <source>Of all points from their meshes.</source>
        <translation>全点のメッシュからの値です。</translation>
    </message>
    <message>
        <source>RMSE</source>
        <translation>RMSE</translation>
    </message>
    <message>
        <source>Number of all triangles.</source>
        <translation>全三角形の数です。</translation>
    </message>
    <message>
        <source>HTML report: counts, quality, the worst buildings with reasons.</source>
        <translation>HTML報告書です。個数、品質、評価の低い建物とその理由を示します。</translation>
    </message>
    <message>
        <source>2.5D meshes</source>
        <translation>2.5Dメッシュ</translation>
    </message>
    <message>
        <source>Buildings with a model.</source>
        <translation>モデルのある建物の数です。</translation>
    </message>
    <message>
        <source>Modelled</source>
        <translation>モデル化した建物</translation>
    </message>
    <message>
        <source>Mean over the buildings, where points were given.</source>
        <translation>点を与えた建物についての平均です。</translation>
    </message>
    <message>
        <source>Mean RMSE of height, best 95 %</source>
        <translation>高さのRMSEの平均（良い方から95 %）</translation>
    </message>
    <message>
        <source>Heights of the ground in metres. Without it the ground is made from the points.</source>
        <translation>地表の標高（メートル）。ない場合は点群から地表を作成します。</translation>
    </message>
    <message>
        <source>Least area</source>
        <translation>最小面積</translation>
    </message>
    <message>
        <source>Area in square metres of the smallest building.</source>
        <translation>抽出する建物の最小面積（m2）。</translation>
    </message>
    <message>
        <source>Regularity</source>
        <translation>整形の度合い</translation>
    </message>
    <message>
        <source>How far walls may be moved to make an outline straight and square, in multiples of what the spacing of the points calls for. Less keeps small corners, more leaves them out.</source>
        <translation>外周線を直線的で直角に整えるために壁を動かしてよい量。点の間隔から決まる量に対する倍率です。小さいほど細かな角が残り、大きいほど省かれます。</translation>
    </message>
    <message>
        <source>MultiPolygon, one feature a building: building_id, area (m2), height above the ground and ground (m), points, density (points a m2), sigma of the edges (m), confidence (probability of a roof, mean over the points), status (ok, low, movable, deck, no ground) and reason.</source>
        <translation>MultiPolygon、建物ごとに1地物：building_id、area（m2）、height（地面からの高さ）とground（m）、points、density（点/m2）、sigma（縁の標準偏差、m）、confidence（屋根である確率、点の平均）、status（ok、low、movable、deck、no ground）、reason。</translation>
    </message>
    <message>
        <source>HTML report: counts, areas, and what may be no building.</source>
        <translation>HTML報告書：件数、面積、建物でない可能性のあるもの。</translation>
    </message>
    <message>
        <source>Outlines with status ok.</source>
        <translation>状態がokの外周線の数です。</translation>
    </message>
    <message>
        <source>Outlines of what may be no building.</source>
        <translation>建物でない可能性のある外周線の数です。</translation>
    </message>
    <message>
        <source>Others</source>
        <translation>その他</translation>
    </message>
    <message>
        <source>Area of the buildings.</source>
        <translation>建物の面積です。</translation>
    </message>
    <message>
        <source>Area</source>
        <translation>範囲</translation>
    </message>
    <message>
        <source>Building outlines from ALS</source>
        <translation>航空レーザ点群からの建物外周線</translation>
    </message>
    <message>
        <source>LAS, LAZ or COPC files; they become one.</source>
        <translation>LAS、LAZまたはCOPCファイルです。1つにまとめて出力します。</translation>
    </message>
    <message>
        <source>Raster of heights</source>
        <translation>標高のラスタ</translation>
    </message>
    <message>
        <source>Such as a ground elevation.</source>
        <translation>地表の標高などです。</translation>
    </message>
    <message>
        <source>Layer with heights</source>
        <translation>標高を持つレイヤ</translation>
    </message>
    <message>
        <source>Features with z, such as building models.</source>
        <translation>建物モデルなど、zを持つ地物です。</translation>
    </message>
    <message>
        <source>Height system of the data</source>
        <translation>データの高さの基準</translation>
    </message>
    <message>
        <source>JGD2000, JGD2011, JGD2024, ellipsoidal or the EPSG code of a vertical system; needed where the data do not state it.</source>
        <translation>JGD2000、JGD2011、JGD2024、ellipsoidal（楕円体高）、または鉛直座標系のEPSGコードです。データに記載がない場合に必要です。</translation>
    </message>
    <message>
        <source>Height system of the result</source>
        <translation>結果の高さの基準</translation>
    </message>
    <message>
        <source>Likewise.</source>
        <translation>データの高さの基準と同様に指定します。</translation>
    </message>
    <message>
        <source>Grid</source>
        <translation>グリッド</translation>
    </message>
    <message>
        <source>Corrections (added to the older system's heights) or a geoid model: GSI's text grid (.isg, .asc), GeoTIFF or GTX, in latitude and longitude, m.</source>
        <translation>補正量（旧高さの基準の標高に加える値）またはジオイドモデルです。国土地理院のテキストグリッド（.isg, .asc）、GeoTIFFまたはGTXで、緯度・経度のグリッド、単位はmです。</translation>
    </message>
    <message>
        <source>One value</source>
        <translation>単一の値</translation>
    </message>
    <message>
        <source>Instead of a grid, one correction or geoid height for all places.</source>
        <translation>グリッドの代わりに、すべての場所に適用する1つの補正量またはジオイド高です。</translation>
    </message>
    <message>
        <source>Against the grid</source>
        <translation>グリッドの逆方向</translation>
    </message>
    <message>
        <source>The corrections of the grid lead from the result's system to that of the data. Between JGD2000, JGD2011 and JGD2024 this is known and need not be said.</source>
        <translation>グリッドの補正量が、結果の高さの基準からデータの高さの基準へのものである場合に指定します。JGD2000、JGD2011、JGD2024 の間では自動的に判断するので指定は不要です。</translation>
    </message>
    <message>
        <source>With converted heights, all attributes kept.</source>
        <translation>標高を変換し、すべての属性を保持します。</translation>
    </message>
    <message>
        <source>Raster</source>
        <translation>ラスタ</translation>
    </message>
    <message>
        <source>With converted heights.</source>
        <translation>標高を変換したものです。</translation>
    </message>
    <message>
        <source>Layer</source>
        <translation>レイヤ</translation>
    </message>
    <message>
        <source>The features with converted z. Heights in fields, such as base or ground, stay as they are: a warning names them.</source>
        <translation>zを変換した地物です。baseやgroundなど、フィールドにある標高はそのままで、該当するものを警告で示します。</translation>
    </message>
    <message>
        <source>Of all heights.</source>
        <translation>すべての標高についての値です。</translation>
    </message>
    <message>
        <source>Least change</source>
        <translation>最小の変化</translation>
    </message>
    <message>
        <source>Mean change</source>
        <translation>平均の変化</translation>
    </message>
    <message>
        <source>Largest change</source>
        <translation>最大の変化</translation>
    </message>
    <message>
        <source>MultiPolygonZ with all faces of each building, such as those of “Building models”. Without it give a city model.</source>
        <translation>「建物モデル」の出力など、建物ごとにすべての面を持つMultiPolygonZです。指定しない場合は都市モデルを指定してください。</translation>
    </message>
    <message>
        <source>City models (*.gml *.GML *.zip *.json *.jsonl *.xml);;All files (*)</source>
        <translation>都市モデル (*.gml *.GML *.zip *.json *.jsonl *.xml);;すべてのファイル (*)</translation>
    </message>
    <message>
        <source>City model</source>
        <translation>都市モデル</translation>
    </message>
    <message>
        <source>CityGML (.gml, .zip) or CityJSON file instead of the layer: its buildings are written with all that they hold, and nothing is added. Of CityGML roads, city furniture and trees are written, too.</source>
        <translation>レイヤの代わりとするCityGML（.gml、.zip）またはCityJSONのファイル。建物は持つものすべてとともに書き出され、何も加えられません。CityGMLの道路、都市設備、樹木も書き出されます。</translation>
    </message>
    <message>
        <source>CityGML (.gml, or a .zip of them), CityJSON (.json) or CityJSONSeq (.jsonl). The path of a folder, such as that of a PLATEAU data set, can be typed here as well.</source>
        <translation>CityGML（.gml、またはそれらの.zip）、CityJSON（.json）またはCityJSONSeq（.jsonl）です。PLATEAUのデータセットなどのフォルダのパスも入力できます。</translation>
    </message>
    <message>
        <source>Folder of city models</source>
        <translation>都市モデルのフォルダ</translation>
    </message>
    <message>
        <source>All city models in this folder and its subfolders; instead of the file or beside it.</source>
        <translation>このフォルダとサブフォルダにあるすべての都市モデルです。ファイルの代わりに、またはファイルと併せて指定します。</translation>
    </message>
    <message>
        <source>Projected system of the result. If none is chosen, that of the model, or for degrees in Japan the zone of the Japan Plane Rectangular CS in which the first building lies.</source>
        <translation>結果の投影座標系です。選択しない場合はモデルの座標系とし、日本の経緯度座標の場合は最初の建物がある平面直角座標系の系とします。</translation>
    </message>
    <message>
        <source>CRS of the city model</source>
        <translation>都市モデルの座標参照系</translation>
    </message>
    <message>
        <source>Of files that name none, or one that is not known.</source>
        <translation>座標参照系の記載がないファイル、または記載された座標参照系が不明なファイルの座標参照系です。</translation>
    </message>
    <message>
        <source>MultiPolygon outlines (footprint, else roof edge, else the plan of the solid) with building_id (the model's own id), lod (levels there are), ground and top (heights in m), height (m, measuredHeight where it is given), parts, note (what is wrong), attributes (all, as JSON), and simple attributes as fields.</source>
        <translation>MultiPolygonの外周線（フットプリント、なければ屋根の縁、なければ立体の平面形）です。building_id（モデル自体のid）、lod（含まれる詳細度）、groundとtop（標高、m）、height（m、あればmeasuredHeight）、parts、note（問題点）、attributes（すべての属性、JSON）と、フィールドにした単純な属性を持ちます。</translation>
    </message>
    <message>
        <source>MultiPolygonZ, one feature a building with all faces of its most detailed solid, as “Building models” writes them.</source>
        <translation>建物ごとに1地物のMultiPolygonZです。「建物モデル」の出力と同じく、最も詳細な立体のすべての面を持ちます。</translation>
    </message>
    <message>
        <source>PolygonZ, one feature a face, with building_id, roof_id and surface_type: roof, outer wall, inner wall, ground, overhang.</source>
        <translation>面ごとに1地物のPolygonZです。building_id、roof_id、surface_type（roof 屋根、outer wall 外壁、inner wall 内壁、ground 地面、overhang 張り出し）を持ちます。</translation>
    </message>
    <message>
        <source>MultiPolygon surfaces of the roads (tran:Road) of CityGML, of their plainest level of detail: road_id, lod, class, function, usage, section (code of the kind of section), width (m), note, attributes (all, as JSON).</source>
        <translation>CityGML の道路（tran:Road）の、最も簡略な LOD の面（MultiPolygon）：road_id、lod、class、function、usage、section（道路構造の種別のコード）、width（m）、note、attributes（全属性、JSON）。</translation>
    </message>
    <message>
        <source>Street objects</source>
        <translation>道路沿いの地物</translation>
    </message>
    <message>
        <source>MultiPolygonZ, city furniture and single trees (frn, veg) of CityGML, the faces of their most detailed level: object_id, kind (furniture, tree), lod, class, function, usage, species (codes), ground and top (m), height (m, as given, else of the faces), note, attributes (all, as JSON).</source>
        <translation>MultiPolygonZ。CityGML の都市設備と単独木（frn、veg）の、最も詳細な LOD の面。object_id、kind（furniture は都市設備、tree は樹木）、lod、class、function、usage、species（コード）、ground と top（m）、height（m。属性にあればその値、なければ面から）、note、attributes（全属性の JSON）。</translation>
    </message>
    <message>
        <source>Number of buildings written.</source>
        <translation>書き出した建物の数です。</translation>
    </message>
    <message>
        <source>Number of buildings</source>
        <translation>建物の数</translation>
    </message>
    <message>
        <source>Buildings in which something is wrong.</source>
        <translation>何らかの問題がある建物の数です。</translation>
    </message>
    <message>
        <source>Buildings with a note</source>
        <translation>注記のある建物</translation>
    </message>
    <message>
        <source>As the model says it: unknown, JGD2011, JGD2024, ...</source>
        <translation>モデルの記載によるもの：unknown（不明）、JGD2011、JGD2024など。</translation>
    </message>
    <message>
        <source>Height system</source>
        <translation>高さの基準</translation>
    </message>
    <message>
        <source>Surfaces of “Building models”, for the roofs' ids and the types of walls; without them types are told by the faces.</source>
        <translation>「建物モデル」による面です。屋根のidと壁の種別に使います。指定しない場合、種別は面から判定します。</translation>
    </message>
    <message>
        <source>CityJSON file of “Facade textures” of the same buildings: its images go along.</source>
        <translation>「壁面テクスチャ」による同じ建物のCityJSONファイルです。その画像も出力します。</translation>
    </message>
    <message>
        <source>Id field</source>
        <translation>IDフィールド</translation>
    </message>
    <message>
        <source>Field with the source's own ids. Without it gml_id or building_id is taken.</source>
        <translation>元データのidを持つフィールドです。指定しない場合はgml_idまたはbuilding_idを使います。</translation>
    </message>
    <message>
        <source>What heights count from, where the layer's CRS does not say it: JGD2011, JGD2024, ellipsoidal or the EPSG code of a vertical system.</source>
        <translation>レイヤの座標参照系に記載がない場合の標高の基準です：JGD2011、JGD2024、ellipsoidal（楕円体高）、または鉛直座標系のEPSGコード。</translation>
    </message>
    <message>
        <source>GeoTIFF, GTX or text grid of GSI (.asc, .isg) of the geoid's heights above the ellipsoid: 3D Tiles then have ellipsoidal heights, as globes want them.</source>
        <translation>楕円体からのジオイド高のGeoTIFF、GTX、または国土地理院のテキストグリッド（.asc, .isg）です。これにより、3D Tilesは地球儀型ビューアが必要とする楕円体高になります。</translation>
    </message>
    <message>
        <source>Municipality's code</source>
        <translation>市区町村コード</translation>
    </message>
    <message>
        <source>Five digits, such as 13101: CityGML then has the buildings' ids as PLATEAU asks for them.</source>
        <translation>13101のような5桁の数字です。CityGMLの建物のidがPLATEAUの求める形式になります。</translation>
    </message>
    <message>
        <source>i-UR version</source>
        <translation>i-UR のバージョン</translation>
    </message>
    <message>
        <source>Version of PLATEAU's extension of CityGML: 3.2 of the specification in force, 3.1 or 2.0. (3.2, 3.1, 2.0)</source>
        <translation>PLATEAU の CityGML 拡張（i-UR）のバージョンです。現行の標準製品仕様書は 3.2 で、3.1 と 2.0 も選べます。（3.2、3.1、2.0）</translation>
    </message>
    <message>
        <source>Map level of the public survey</source>
        <translation>公共測量の地図情報レベル</translation>
    </message>
    <message>
        <source>no public survey</source>
        <translation>公共測量成果ではない</translation>
    </message>
    <message>
        <source>Level of the public survey that the laser points are of, for CityGML's quality attributes; none where they are of no public survey. (none, 500, 1000, 2500, 5000)</source>
        <translation>レーザ点群が公共測量成果である場合の地図情報レベルで、CityGML の品質属性に記録します。公共測量成果でない場合は none とします。（none、500、1000、2500、5000）</translation>
    </message>
    <message>
        <source>Schemas of i-UR</source>
        <translation>i-UR のスキーマ</translation>
    </message>
    <message>
        <source>Folder with uro/3.2/urbanObject.xsd and urf/3.2/urbanFunction.xsd (of the version above), as the G-spatial information centre gives them: they go along with CityGML into the folder “schemas”.</source>
        <translation>uro/3.2/urbanObject.xsd と urf/3.2/urbanFunction.xsd（上で選んだ版のもの）のあるフォルダ（G空間情報センターで配布）。CityGML とともに「schemas」フォルダに入れます。</translation>
    </message>
    <message>
        <source>Date of the data</source>
        <translation>データの作成日</translation>
    </message>
    <message>
        <source>Day on which the buildings were measured, such as 2026-04-01.</source>
        <translation>建物を計測した日です（例：2026-04-01）。</translation>
    </message>
    <message>
        <source>Title</source>
        <translation>タイトル</translation>
    </message>
    <message>
        <source>Title of the data set.</source>
        <translation>データセットのタイトルです。</translation>
    </message>
    <message>
        <source>Buildings with figures</source>
        <translation>数値付きの建物</translation>
    </message>
    <message>
        <source>The models with the fields of the layer, city_id, ground_height, roof_min, roof_50, roof_70, roof_max (m above the ground), volume_lod12, volume_lod13, volume_lod22 (m3), area_ground, area_roof_flat, area_roof_sloped, area_outer_walls, area_party_walls (m2), storeys_estimated, data_date, problems. A name ending in .parquet gives GeoParquet where GDAL has it.</source>
        <translation>モデルに、レイヤのフィールド、city_id、ground_height、roof_min、roof_50、roof_70、roof_max（地表からのm）、volume_lod12、volume_lod13、volume_lod22（m3）、area_ground、area_roof_flat、area_roof_sloped、area_outer_walls、area_party_walls（m2）、storeys_estimated、data_date、problemsを付けたものです。名称が.parquetで終わる場合、GDALが対応していればGeoParquetになります。</translation>
    </message>
    <message>
        <source>CityJSON 2.0 file.</source>
        <translation>CityJSON 2.0ファイルです。</translation>
    </message>
    <message>
        <source>CityJSONSeq</source>
        <translation>CityJSONSeq</translation>
    </message>
    <message>
        <source>CityJSONSeq (*.city.jsonl *.jsonl)</source>
        <translation>CityJSONSeq (*.city.jsonl *.jsonl)</translation>
    </message>
    <message>
        <source>CityJSON sequence, a line a building, for large areas.</source>
        <translation>1行に1建物のCityJSONシーケンスです。広い範囲に適します。</translation>
    </message>
    <message>
        <source>CityGML</source>
        <translation>CityGML</translation>
    </message>
    <message>
        <source>Folder of CityGML 2.0: in Japan udx/bldg with a file a mesh, EPSG:6697, and codelists; elsewhere one file.</source>
        <translation>CityGML 2.0のフォルダです。日本ではudx/bldgにメッシュごとのファイル（EPSG:6697）とcodelistsを、それ以外では1つのファイルを出力します。</translation>
    </message>
    <message>
        <source>3D Tiles</source>
        <translation>3D Tiles</translation>
    </message>
    <message>
        <source>Folder with tileset.json and its tiles.</source>
        <translation>tileset.jsonとそのタイルのフォルダです。</translation>
    </message>
    <message>
        <source>Buildings of which a solid is not closed or not valid.</source>
        <translation>立体が閉じていない、または正しくない建物の数です。</translation>
    </message>
    <message>
        <source>Not closed</source>
        <translation>閉じていない建物</translation>
    </message>
    <message>
        <source>GSI data (*.xml *.XML *.zip *.ZIP);;All files (*)</source>
        <translation>国土地理院のデータ (*.xml *.XML *.zip *.ZIP);;すべてのファイル (*)</translation>
    </message>
    <message>
        <source>File of the GSI</source>
        <translation>国土地理院のファイル</translation>
    </message>
    <message>
        <source>FG-GML-...-BldA, -BldL or -DEM5A-... .xml (or another product), or a .zip as downloaded (zips inside are opened too). The path of a folder can be typed here as well.</source>
        <translation>FG-GML-...-BldA、-BldLまたは-DEM5A-...（またはほかの製品）の.xml、またはダウンロードしたままの.zipです（内部のzipも開きます）。フォルダのパスも入力できます。</translation>
    </message>
    <message>
        <source>Folder of GSI data</source>
        <translation>国土地理院のデータのフォルダ</translation>
    </message>
    <message>
        <source>All .xml and .zip files in this folder and its subfolders; instead of the file or beside it.</source>
        <translation>このフォルダとサブフォルダにあるすべての.xmlと.zipファイルです。ファイルの代わりに、またはファイルと併せて指定します。</translation>
    </message>
    <message>
        <source>Of the results. If none is chosen, the zone of the Japan Plane Rectangular CS (JGD2011, EPSG:6669 to 6687) in which most of it lies; close to the border of a prefecture, check it. In degrees (EPSG:6668) the cells of the raster stay as they are in the files.</source>
        <translation>結果の座標参照系です。選択しない場合は、大半が入る平面直角座標系の系（JGD2011、EPSG:6669～6687）とします。都道府県の境界付近では確認してください。度単位（EPSG:6668）の場合、ラスタのセルはファイルのままです。</translation>
    </message>
    <message>
        <source>Cell size</source>
        <translation>セルサイズ</translation>
    </message>
    <message>
        <source>Side of a cell in units of the coordinate reference system; if none is given, that of the finest product: 1, 5 or 10 m, or its fraction of a second.</source>
        <translation>セルの一辺で、座標参照系の単位によります。指定しない場合は最も細かい製品の値です: 1、5、10 m、またはそれに当たる秒の分数。</translation>
    </message>
    <message>
        <source>Footprints</source>
        <translation>建物外周線</translation>
    </message>
    <message>
        <source>Polygons with building_id (1, 2, 3, ... in the order of the files), the GSI's attributes as text (its fid as gsi_fid) and the file's name as source.</source>
        <translation>building_id（ファイルの順に1, 2, 3, ...）、国土地理院の属性（テキスト。fidはgsi_fid）、ファイル名（source）を持つポリゴンです。</translation>
    </message>
    <message>
        <source>GeoTIFF of heights in metres; cells without height are no data.</source>
        <translation>標高（メートル）のGeoTIFF。標高のないセルはノーデータです。</translation>
    </message>
    <message>
        <source>Number of footprints written.</source>
        <translation>書き出した建物外周線の数です。</translation>
    </message>
    <message>
        <source>Coordinate reference system of the footprints, such as EPSG:6677.</source>
        <translation>建物外周線の座標参照系です（例：EPSG:6677）。</translation>
    </message>
    <message>
        <source>Name of the coordinate reference system</source>
        <translation>座標参照系の名称</translation>
    </message>
    <message>
        <source>Number of files that the raster was made of.</source>
        <translation>ラスタの作成に用いたファイルの数です。</translation>
    </message>
    <message>
        <source>Number of meshes</source>
        <translation>メッシュ数</translation>
    </message>
    <message>
        <source>Cells without height (sea, or no mesh), 0 to 1.</source>
        <translation>標高のないセル（海、またはメッシュなし）の割合、0～1。</translation>
    </message>
    <message>
        <source>Share of empty cells</source>
        <translation>空のセルの割合</translation>
    </message>
    <message>
        <source>JGD2000, JGD2011 or JGD2024, as the files say.</source>
        <translation>JGD2000、JGD2011またはJGD2024（ファイルの記載による）。</translation>
    </message>
    <message>
        <source>MultiPolygonZ of “Building models”: level roofs, upright walls. Without them give a CityJSON file.</source>
        <translation>「建物モデル」のMultiPolygonZ: 水平な屋根と鉛直な壁面。ない場合はCityJSONファイルを指定してください。</translation>
    </message>
    <message>
        <source>Building models (CityJSON)</source>
        <translation>建物モデル（CityJSON）</translation>
    </message>
    <message>
        <source>CityJSON file with solids, in the coordinate system of the walls, instead of the layer.</source>
        <translation>レイヤの代わりに用いる、立体を含むCityJSONファイル。座標系は壁面と同じとします。</translation>
    </message>
    <message>
        <source>PolygonZ of “Walls from a mobile survey”. Walls of few points, rough ones, those inside the outlines and what stands before facades are left out.</source>
        <translation>「MMS計測の壁面」のPolygonZ。点の少ない壁面、粗い壁面、外周線の内側にある壁面、壁面の前にある物は除かれます。</translation>
    </message>
    <message>
        <source>Walls by GNSS</source>
        <translation>GNSSによる壁面</translation>
    </message>
    <message>
        <source>Walls of “Adjust walls by GNSS” from these models: where nothing was measured from the street, adjusted and likely ones move the models' walls, weighed by their sigma; where they contradict a measured wall, the note tells it.</source>
        <translation>このモデルから「GNSSによる壁面の調整」で得た壁面。道路から計測されていない所では、調整済みと推定の壁面が標準偏差に応じてモデルの壁面を動かします。計測された壁面と矛盾する場合は備考に示します。</translation>
    </message>
    <message>
        <source>Sigma of the models' walls</source>
        <translation>モデルの壁面の標準偏差</translation>
    </message>
    <message>
        <source>How well the models' own walls are known (standard deviation): walls by GNSS move them little where they are known better.</source>
        <translation>モデルの壁面の位置がどの程度正確か（標準偏差）。正確なほど、GNSSによる壁面ではわずかしか動きません。</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>高さ</translation>
    </message>
    <message>
        <source>Height in metres above the ground of each model up to which measured walls are taken.</source>
        <translation>計測壁面を採用する範囲の上限で、各モデルの地盤からの高さ（メートル）です。</translation>
    </message>
    <message>
        <source>Maximum offset</source>
        <translation>最大オフセット</translation>
    </message>
    <message>
        <source>Maximum distance in metres by which a wall moves to the measured one.</source>
        <translation>壁面を計測壁面へ移動する距離の上限（メートル）です。</translation>
    </message>
    <message>
        <source>Maximum rotation</source>
        <translation>最大回転角</translation>
    </message>
    <message>
        <source>°</source>
        <translation>°</translation>
    </message>
    <message>
        <source>Maximum angle between a wall and the measured one.</source>
        <translation>壁面と計測壁面のなす角の上限です。</translation>
    </message>
    <message>
        <source>Minimum share measured</source>
        <translation>最小計測割合</translation>
    </message>
    <message>
        <source>Minimum share of a wall's length, 0 to 1, that must have been measured for it to move.</source>
        <translation>壁面を移動するために計測されていなければならない、壁面の長さに対する割合の下限（0～1）です。</translation>
    </message>
    <message>
        <source>Minimum overhang</source>
        <translation>最小張り出し</translation>
    </message>
    <message>
        <source>A roof that stands out further than this over the measured wall stays where it is, in metres; others follow the wall.</source>
        <translation>計測壁面からこの値（メートル）を超えて張り出す屋根はそのままの位置に残り、それ以外は壁面に追随します。</translation>
    </message>
    <message>
        <source>Merged models</source>
        <translation>統合後のモデル</translation>
    </message>
    <message>
        <source>MultiPolygonZ, one feature a building with all faces of its solids; status, reason, valid, walls, walls_moved, measured (share of the walls' length), mean_offset, max_offset, base, height (m), volume, volume_change (m3).</source>
        <translation>MultiPolygonZ、建物ごとに1地物で立体の全面を含みます: status、reason、valid、walls、walls_moved、measured（壁面長に対する割合）、mean_offset、max_offset、base、height（m）、volume、volume_change（m3）。</translation>
    </message>
    <message>
        <source>Walls of the models</source>
        <translation>モデルの壁面</translation>
    </message>
    <message>
        <source>PolygonZ, one feature an outer wall below the height, with what became of it: building_id, edge, status, note, wall (row of the measured wall), length, offset (m), turn (degrees), seen (share), rmse, sigma (m).</source>
        <translation>PolygonZ、指定の高さより下の外壁ごとに1地物で、その処理結果を示します: building_id、edge、status、note、wall（計測壁面の行）、length、offset（m）、turn（度）、seen（割合）、rmse、sigma（m）。</translation>
    </message>
    <message>
        <source>CityJSON 2.0 file with the solids.</source>
        <translation>立体を含むCityJSON 2.0ファイル。</translation>
    </message>
    <message>
        <source>Orthophoto for the report</source>
        <translation>報告書用のオルソ画像</translation>
    </message>
    <message>
        <source>The report shows edges before and after over it; it changes nothing else.</source>
        <translation>報告書で、統合前後の辺をこの上に表示します。ほかには影響しません。</translation>
    </message>
    <message>
        <source>What was merged and what not, and edges before and after over the orthophoto, as HTML.</source>
        <translation>統合したものとしなかったもの、およびオルソ画像上の統合前後の辺（HTML）。</translation>
    </message>
    <message>
        <source>Number of models.</source>
        <translation>モデルの数です。</translation>
    </message>
    <message>
        <source>Buildings with a wall that moved.</source>
        <translation>壁面が移動した建物です。</translation>
    </message>
    <message>
        <source>Merged</source>
        <translation>統合済み</translation>
    </message>
    <message>
        <source>Buildings that could not be merged.</source>
        <translation>統合できなかった建物です。</translation>
    </message>
    <message>
        <source>Not merged</source>
        <translation>統合不可</translation>
    </message>
    <message>
        <source>Buildings whose solids passed the check.</source>
        <translation>立体が検査に合格した建物です。</translation>
    </message>
    <message>
        <source>Valid</source>
        <translation>有効</translation>
    </message>
    <message>
        <source>Outer walls that lie on measured ones now.</source>
        <translation>計測壁面上に位置するようになった外壁です。</translation>
    </message>
    <message>
        <source>Walls moved</source>
        <translation>移動した壁面</translation>
    </message>
    <message>
        <source>Merge building models with measured walls</source>
        <translation>建物モデルと計測壁面の統合</translation>
    </message>
    <message>
        <source>Points with the attributes building_id and roof_id, from “Segment roofs”.</source>
        <translation>「屋根の分割」による、属性building_idとroof_idをもつ点。</translation>
    </message>
    <message>
        <source>Outlines from “Segment buildings”.</source>
        <translation>「建物の抽出」による外周線。</translation>
    </message>
    <message>
        <source>partition of the outline</source>
        <translation>外周線の分割</translation>
    </message>
    <message>
        <source>outline of the points</source>
        <translation>点群の輪郭</translation>
    </message>
    <message>
        <source>How the polygons are drawn. (partition, points, paper)</source>
        <translation>ポリゴンの描き方です。(partition, points, paper)</translation>
    </message>
    <message>
        <source>planes: polygons on the planes of their points, with edges where planes meet (LoD2.2); levels: level polygons (LoD1.3). The paper's method has levels always. (planes, levels)</source>
        <translation>planes: 点群の平面上のポリゴンで、平面どうしの交線を辺とします（LoD2.2）。levels: 水平なポリゴン（LoD1.3）。論文の方法では常にlevelsです。(planes, levels)</translation>
    </message>
    <message>
        <source>Roof height</source>
        <translation>屋根の高さ</translation>
    </message>
    <message>
        <source>median</source>
        <translation>中央値</translation>
    </message>
    <message>
        <source>highest point</source>
        <translation>最高点</translation>
    </message>
    <message>
        <source>Height of a level roof from its points: the median, or the highest point as in the paper (the top of the parapet). The paper's method always takes the highest point. (robust, maximum)</source>
        <translation>水平な屋根の高さの点群からの決め方: 中央値、または論文のとおり最高点（パラペットの上端）。論文の方法では常に最高点です。(robust, maximum)</translation>
    </message>
    <message>
        <source>Minimum points of an edge</source>
        <translation>辺の最小点数</translation>
    </message>
    <message>
        <source>points</source>
        <translation>点数</translation>
    </message>
    <message>
        <source>Boundary points that a line must have to be an edge, in the paper's method (its n).</source>
        <translation>論文の方法で、線を辺とするために必要な境界点の数（論文のn）です。</translation>
    </message>
    <message>
        <source>PolygonZ at the roofs' heights: building_id, roof_id (0: plain block), height, height_max (m), points, density (points a m2), rmse (m), coverage (share of the area with points), slope (degrees), azimuth (degrees from north, where it falls to), status.</source>
        <translation>屋根の高さにあるPolygonZ: building_id、roof_id（0: 単純ブロック）、height、height_max（m）、points、density（点/m2）、rmse（m）、coverage（点のある面積の割合）、slope（度）、azimuth（北からの度、下り方向）、status。</translation>
    </message>
    <message>
        <source>Outlines that got no polygon.</source>
        <translation>ポリゴンが得られなかった外周線です。</translation>
    </message>
    <message>
        <source>Buildings without a roof</source>
        <translation>屋根のない建物</translation>
    </message>
    <message>
        <source>Rough outlines, one feature a building, in the same coordinate system as the points. A field building_id, of any type, names the buildings and comes back in every result; ids that a point cloud cannot hold get a number beside them (bldg_no). Without it, buildings are numbered from 1 in the layer's order.</source>
        <translation>概略の外周線。建物ごとに1地物で、座標系は点群と同じとします。フィールドbuilding_id（型は任意）が建物の名称となり、すべての結果に引き継がれます。点群に格納できないidには番号（bldg_no）が併記されます。このフィールドがない場合は、レイヤの順に1から番号を付けます。</translation>
    </message>
    <message>
        <source>Expansion</source>
        <translation>拡張幅</translation>
    </message>
    <message>
        <source>Distance in metres by which outlines are expanded before they take their points.</source>
        <translation>点を取り込む前に外周線を拡張する距離（メートル）です。</translation>
    </message>
    <message>
        <source>The full method adjusts the outlines and chooses the points that can be building. The paper's takes all points in the expanded outlines as they are given; a point in several is written once for each. (full, paper)</source>
        <translation>fullは外周線の位置を合わせ、建物になり得る点を選びます。paperは、与えられたままの外周線を拡張した範囲の全点を取り、複数の範囲に入る点はそれぞれに1回ずつ書き出します。(full, paper)</translation>
    </message>
    <message>
        <source>Maximum displacement</source>
        <translation>最大変位</translation>
    </message>
    <message>
        <source>Distance in metres by which an outline may be moved to its points; 0 leaves all outlines in their places.</source>
        <translation>外周線を点群に合わせて移動する距離の上限（メートル）です。0ではすべての外周線をそのままの位置に残します。</translation>
    </message>
    <message>
        <source>Minimum building height</source>
        <translation>建物の最小高さ</translation>
    </message>
    <message>
        <source>Height in metres above the ground from which points without a class can belong to a building.</source>
        <translation>クラスのない点を建物の点とみなす、地表からの高さの下限（メートル）です。</translation>
    </message>
    <message>
        <source>Building points</source>
        <translation>建物点群</translation>
    </message>
    <message>
        <source>The points of the buildings with the attribute building_id, building after building; all other attributes are kept.</source>
        <translation>属性building_idを付けた建物の点群（建物順）。その他の属性はすべて保持されます。</translation>
    </message>
    <message>
        <source>The outlines at their found places, with building_id, points, density (points a m2), ground (m), shift_x, shift_y, shift_sigma (m), shift_status, status, open_share (share of the outline cut out as open ground), cloud_density (points a m2 of the cloud round it) and beyond (share of the outline beyond the cloud's edge).</source>
        <translation>位置合わせ後の外周線: building_id、points、density（点/m2）、ground（m）、shift_x、shift_y、shift_sigma（m）、shift_status、status、open_share（空地として切り取った外周線内の割合）、cloud_density（周囲の点群の密度、点/m2）、beyond（外周線内のうち点群の端の外にある割合）。</translation>
    </message>
    <message>
        <source>Outlines with too few points for a model.</source>
        <translation>点が少なくモデルを作成できない外周線です。</translation>
    </message>
    <message>
        <source>Buildings without points</source>
        <translation>点のない建物</translation>
    </message>
    <message>
        <source>Points given to buildings.</source>
        <translation>建物に割り当てた点です。</translation>
    </message>
    <message>
        <source>Points with the attribute building_id, from “Segment buildings”.</source>
        <translation>「建物の抽出」による、属性building_idをもつ点。</translation>
    </message>
    <message>
        <source>Outlines from “Segment buildings”; their fields ground and density are used where they are there.</source>
        <translation>「建物の抽出」による外周線。フィールドgroundとdensityがあれば使用します。</translation>
    </message>
    <message>
        <source>The full method segments roofs in the histogram and in plan. The paper's has the histogram alone: all points in the expanded outline, maxima of at least the minimum roof area times the density; it uses bin width, bin shift, minimum roof area and parapet threshold only. (full, paper)</source>
        <translation>fullはヒストグラムと平面の両方で屋根を分割します。paperはヒストグラムのみで、拡張した外周線内の全点を用い、最小屋根面積×点密度以上の極大を採用します。使用するのはビン幅、ビンの移動量、最小屋根面積、パラペットしきい値だけです。(full, paper)</translation>
    </message>
    <message>
        <source>planes: level and sloped roof planes (LoD2.2); levels: level roofs, sloped ones cut into steps (LoD1.3). The paper's method has levels always. (planes, levels)</source>
        <translation>planes: 水平および傾斜した屋根面（LoD2.2）。levels: 水平な屋根とし、傾斜屋根は段に分けます（LoD1.3）。論文の方法では常にlevelsです。(planes, levels)</translation>
    </message>
    <message>
        <source>Bin width</source>
        <translation>ビン幅</translation>
    </message>
    <message>
        <source>Width of a histogram bin in metres.</source>
        <translation>ヒストグラムのビンの幅（メートル）です。</translation>
    </message>
    <message>
        <source>Bin shift</source>
        <translation>ビンの移動量</translation>
    </message>
    <message>
        <source>Distance in metres from one bin to the next; smaller than the width, so that bins overlap.</source>
        <translation>ビンから次のビンまでの距離（メートル）です。幅より小さくして、ビンを重複させます。</translation>
    </message>
    <message>
        <source>Minimum roof area</source>
        <translation>最小屋根面積</translation>
    </message>
    <message>
        <source>Area in square metres that a maximum of the histogram must hold to be a roof (times the density: the paper's alpha).</source>
        <translation>ヒストグラムの極大を屋根とするために必要な面積（平方メートル）です（点密度を掛けると論文のα）。</translation>
    </message>
    <message>
        <source>Parapet threshold</source>
        <translation>パラペットしきい値</translation>
    </message>
    <message>
        <source>Two maxima are one roof where the histogram between them stays above this number of points (the paper's beta). Without it, 0.3 of the smaller maximum; with the paper's method, 0.3 of alpha.</source>
        <translation>2つの極大の間のヒストグラムがこの点数を上回る場合、1つの屋根とします（論文のβ）。指定しない場合は小さい方の極大の0.3倍、論文の方法ではαの0.3倍です。</translation>
    </message>
    <message>
        <source>Minimum roof share</source>
        <translation>最小屋根割合</translation>
    </message>
    <message>
        <source>The minimum roof area is no more than this share of the outline's area, so that small buildings have roofs too; 1 asks for the minimum roof area everywhere but in buildings smaller than that.</source>
        <translation>小さな建物にも屋根が得られるよう、最小屋根面積を外周線の面積に対するこの割合までに抑えます。1では、最小屋根面積より小さい建物を除き、常に最小屋根面積を求めます。</translation>
    </message>
    <message>
        <source>Minimum area of a small roof</source>
        <translation>小屋根の最小面積</translation>
    </message>
    <message>
        <source>Area in square metres of the smallest part that stands out in height and becomes a roof of its own.</source>
        <translation>高さが周囲と異なり、独立した屋根とする部分の最小面積（平方メートル）です。</translation>
    </message>
    <message>
        <source>Height error of sloped roofs</source>
        <translation>傾斜屋根の高さ誤差</translation>
    </message>
    <message>
        <source>Sloped roofs are cut into level ones until the building's root mean square height error in metres is below this; 0 keeps the roofs of the paper whole.</source>
        <translation>建物の高さのRMSE（メートル）がこの値を下回るまで、傾斜屋根を水平な屋根に分けます。0では論文の屋根を分けません。</translation>
    </message>
    <message>
        <source>Minimum roof height</source>
        <translation>屋根の最小高さ</translation>
    </message>
    <message>
        <source>Height in metres above the ground below which nothing is a roof.</source>
        <translation>これより低い部分を屋根としない、地表からの高さ（メートル）です。</translation>
    </message>
    <message>
        <source>Plane tolerance</source>
        <translation>平面の許容距離</translation>
    </message>
    <message>
        <source>Largest distance in metres of a point from its roof plane; three to four times the noise of the heights.</source>
        <translation>点の屋根面からの距離の上限（メートル）です。高さのノイズの3～4倍とします。</translation>
    </message>
    <message>
        <source>Minimum area of a plane</source>
        <translation>平面の最小面積</translation>
    </message>
    <message>
        <source>Area in square metres of the smallest roof plane.</source>
        <translation>最小の屋根面の面積（平方メートル）です。</translation>
    </message>
    <message>
        <source>The buildings' points with the attribute roof_id: the number of the roof in its building, 0 for trees, walls and roof furniture.</source>
        <translation>属性roof_idを付けた建物の点群: 建物内での屋根の番号。樹木、壁面、屋上設備は0です。</translation>
    </message>
    <message>
        <source>Table of the roofs: building_id, roof_id, height (robust, m), height_max (highest point as in the paper, m), points, area (m2), density (points a m2), rmse (m), slope (degrees), azimuth (degrees from north, where it falls to), status.</source>
        <translation>屋根の表: building_id、roof_id、height（ロバスト推定、m）、height_max（論文のとおり最高点、m）、points、area（m2）、density（点/m2）、rmse（m）、slope（度）、azimuth（北からの度、下り方向）、status。</translation>
    </message>
    <message>
        <source>Number of roofs found.</source>
        <translation>見つかった屋根の数です。</translation>
    </message>
    <message>
        <source>Buildings in whose points no roof was found.</source>
        <translation>点群に屋根が見つからなかった建物です。</translation>
    </message>
    <message>
        <source>Old building models</source>
        <translation>既存の建物モデル</translation>
    </message>
    <message>
        <source>MultiPolygonZ with all faces of each building, such as those of “Building models” or “Load city model”; outlines alone tell new and gone ones. A field building_id names the buildings.</source>
        <translation>各建物のすべての面を持つMultiPolygonZ（「建物モデル」や「都市モデルの読込み」の結果など）。外周線だけの場合は新築と滅失だけが分かります。building_id フィールドで建物を識別します。</translation>
    </message>
    <message>
        <source>Old city model</source>
        <translation>既存の都市モデル</translation>
    </message>
    <message>
        <source>CityGML (.gml) or CityJSON (.json) file instead of the layer.</source>
        <translation>レイヤの代わりに指定するCityGML（.gml）またはCityJSON（.json）のファイル。</translation>
    </message>
    <message>
        <source>New point clouds</source>
        <translation>新しい点群</translation>
    </message>
    <message>
        <source>Area in square metres of the smallest change and of the smallest new building; smaller ones, such as chimneys and dormers, leave a building the same.</source>
        <translation>変化および新築建物として数える最小面積（m2）。煙突や屋根窓などこれより小さいものは「変化なし」とします。</translation>
    </message>
    <message>
        <source>Least height change</source>
        <translation>高さの最小変化量</translation>
    </message>
    <message>
        <source>Change of a roof's height in metres from which it counts, where the data are exact enough: it has to be three standard deviations as well.</source>
        <translation>屋根の高さの変化として数える最小値（m）。データが十分に正確な場合に限り、標準偏差の3倍以上であることも必要です。</translation>
    </message>
    <message>
        <source>Sigma of the heights</source>
        <translation>高さの標準偏差</translation>
    </message>
    <message>
        <source>Standard deviation in metres of the difference of both epochs' heights on an unchanged roof. Without it, it is found from all roofs.</source>
        <translation>変化のない屋根における、両時期の高さの差の標準偏差（m）。指定しない場合は、すべての屋根から求めます。</translation>
    </message>
    <message>
        <source>Date of the points</source>
        <translation>点群の計測日</translation>
    </message>
    <message>
        <source>Day of the new survey, such as 2026-04-01.</source>
        <translation>新しい計測の日。例：2026-04-01</translation>
    </message>
    <message>
        <source>Updated buildings</source>
        <translation>更新した建物</translation>
    </message>
    <message>
        <source>MultiPolygonZ, all buildings, gone ones with their old shape: building_id, change, height_change (m), area_change (m2), significance (in standard deviations), seen (share), reason, surveyed (day), and the old fields.</source>
        <translation>MultiPolygonZ、すべての建物（滅失したものは元の形状）：building_id、change、height_change（m）、area_change（m2）、significance（標準偏差の倍数）、seen（割合）、reason、surveyed（日）、元のフィールド。</translation>
    </message>
    <message>
        <source>The updated city model; objects that stayed the same keep all their values.</source>
        <translation>更新した都市モデル。変化のないものはすべての値を保ちます。</translation>
    </message>
    <message>
        <source>Folder with the updated CityGML: members that stayed the same keep every byte, changed ones their id and attributes.</source>
        <translation>更新したCityGMLのフォルダ。変化のない要素は1バイトも変わらず、変化した建物はidと属性を保ちます。</translation>
    </message>
    <message>
        <source>HTML report: counts, offset of the epochs, changes.</source>
        <translation>HTML報告書：件数、両時期のずれ、変化の一覧。</translation>
    </message>
    <message>
        <source>New</source>
        <translation>新築</translation>
    </message>
    <message>
        <source>Gone</source>
        <translation>滅失</translation>
    </message>
    <message>
        <source>Changed</source>
        <translation>変化あり</translation>
    </message>
    <message>
        <source>Same</source>
        <translation>変化なし</translation>
    </message>
    <message>
        <source>Not seen</source>
        <translation>未観測</translation>
    </message>
    <message>
        <source>Update building models</source>
        <translation>建物モデルの更新</translation>
    </message>
    <message>
        <source>Mobile survey</source>
        <translation>MMS計測</translation>
    </message>
    <message>
        <source>One or several LAS, LAZ or COPC files of a survey that lies on the map, such as from “Apply corrected trajectory”.</source>
        <translation>「補正軌跡の適用」の結果など、地図に合った計測のLAS、LAZまたはCOPCファイル（1つまたは複数）。</translation>
    </message>
    <message>
        <source>Outlines, or models with their heights (MultiPolygonZ of “Building models”). A field building_id, of any type, names the buildings; without it, buildings are numbered from 1 in the layer's order.</source>
        <translation>外周線、または高さをもつモデル（「建物モデル」のMultiPolygonZ）。フィールドbuilding_id（型は任意）が建物の名称となり、ない場合はレイヤの順に1から番号を付けます。</translation>
    </message>
    <message>
        <source>Maximum height</source>
        <translation>最大高さ</translation>
    </message>
    <message>
        <source>Height in metres above the ground up to which points are used.</source>
        <translation>点を使用する、地表からの高さの上限（メートル）です。</translation>
    </message>
    <message>
        <source>Front with balconies</source>
        <translation>バルコニーのある正面</translation>
    </message>
    <message>
        <source>wall behind balconies</source>
        <translation>バルコニーの奥の壁面</translation>
    </message>
    <message>
        <source>fronts of balconies</source>
        <translation>バルコニーの前面</translation>
    </message>
    <message>
        <source>Which wall of a building is wanted where balconies stand before it. main: the wall behind them; outermost: the fronts of the balconies. Where storeys stand on columns, it is their wall in both. (main, outermost)</source>
        <translation>壁面の前にバルコニーがある場合に採用する壁面です。main：バルコニーの奥の壁面、outermost：バルコニーの前面。ピロティでは、どちらの場合も上階の壁面です。(main, outermost)</translation>
    </message>
    <message>
        <source>Heights of the ground in metres. Without it the ground is taken from the lowest points round each building.</source>
        <translation>地表の標高（メートル）。ない場合は各建物の周囲の最も低い点から求めます。</translation>
    </message>
    <message>
        <source>Where the vehicle was while it measured these points, in their time, CRS and heights, such as the corrected trajectory of each drive: CSV, SBET, or point layers. With them each wall tells what hid it along the lines of sight, and where beams went through it (glass, openings); without them, hidden is a guess from what stands in front.</source>
        <translation>これらの点を計測したときの車両の位置です。点と同じ時刻系・座標参照系・高さで、各走行の補正済み軌跡などを CSV、SBET、または点レイヤで指定します。指定すると、各壁面について視線上で何が隠していたか、ビームがどこを通り抜けたか（ガラス、開口部）が示されます。指定しない場合、hidden は手前にある物からの推定です。</translation>
    </message>
    <message>
        <source>Tolerance of the outlines</source>
        <translation>外周線の許容誤差</translation>
    </message>
    <message>
        <source>How far the outlines may be off, in metres: walls are looked for up to this far from the edges. Inside, setbacks are found at any distance.</source>
        <translation>外周線のずれの許容値（メートル）です。辺からこの距離までの範囲で壁面を探します。内側のセットバックは距離にかかわらず検出します。</translation>
    </message>
    <message>
        <source>Minimum area of a wall</source>
        <translation>壁面の最小面積</translation>
    </message>
    <message>
        <source>Tolerance</source>
        <translation>許容距離</translation>
    </message>
    <message>
        <source>Maximum distance in metres of a wall's points, on the mean of 30 cm, from its plane.</source>
        <translation>壁面の点（30 cmごとの平均）の平面からの距離の上限（メートル）です。</translation>
    </message>
    <message>
        <source>Maximum gap</source>
        <translation>最大間隔</translation>
    </message>
    <message>
        <source>A wall may be interrupted by up to so many metres.</source>
        <translation>壁面の途切れをこのメートル数まで許容します。</translation>
    </message>
    <message>
        <source>Minimum opening</source>
        <translation>最小開口部</translation>
    </message>
    <message>
        <source>Smaller holes in a contour are filled, and their share is reported.</source>
        <translation>輪郭内のこれより小さい穴は埋め、その割合を報告します。</translation>
    </message>
    <message>
        <source>PolygonZ, one feature a contour: building_id, wall_id, status, note, area (m2), height, length (m), azimuth and tilt (degrees), normal_x, normal_y, normal_z, points, passes, rmse, sigma, pass_spread (m), coverage, hidden, unseen, openings, filled (shares), edge and offset (outline edge, and m before it), kind (wall, or what stands before the facade), through (share that beams went through; empty without a trajectory).</source>
        <translation>PolygonZ、輪郭ごとに1地物: building_id、wall_id、status、note、area（m2）、height、length（m）、azimuthとtilt（度）、normal_x、normal_y、normal_z、points、passes、rmse、sigma、pass_spread（m）、coverage、hidden、unseen、openings、filled（割合）、edgeとoffset（外周線の辺と、その前方へのm）、kind（壁面、または壁面の前にある物の種別）、through（ビームが通り抜けた割合。軌跡がなければ空欄）。</translation>
    </message>
    <message>
        <source>Number of contours.</source>
        <translation>輪郭の数です。</translation>
    </message>
    <message>
        <source>Buildings of which a wall was found.</source>
        <translation>壁面が見つかった建物です。</translation>
    </message>
    <message>
        <source>Buildings with walls</source>
        <translation>壁面のある建物</translation>
    </message>
    <message>
        <source>Buildings near points of the survey.</source>
        <translation>計測の点に近い建物です。</translation>
    </message>
    <message>
        <source>Buildings reached</source>
        <translation>計測範囲の建物</translation>
    </message>
    <message>
        <source>Area of all contours.</source>
        <translation>全輪郭の面積です。</translation>
    </message>
    <message>
        <source>Median over the walls of the standard deviation of their place in the survey.</source>
        <translation>計測における壁面位置の標準偏差の、全壁面についての中央値です。</translation>
    </message>
    <message>
        <source>Building models (MultiPolygonZ, such as those of “Building models”) or outlines with heights, in a projected CRS in metres.</source>
        <translation>建物モデル（「建物モデル」によるMultiPolygonZなど）、または高さをもつ外周線。メートル単位の投影座標系とします。</translation>
    </message>
    <message>
        <source>Where the receiver was, in the CRS of the buildings: one or several files (CSV time,x,y,z,roll,pitch,heading, SBET, or point layers).</source>
        <translation>受信機の位置。座標参照系は建物と同じとします。1つまたは複数のファイル（CSV time,x,y,z,roll,pitch,heading、SBET、または点レイヤ）。</translation>
    </message>
    <message>
        <source>Observations</source>
        <translation>観測データ</translation>
    </message>
    <message>
        <source>RINEX 2.11, 3.x or 4.x observation files, plain or compact (Hatanaka), as they are or packed by gzip or bzip2; each file is a pass.</source>
        <translation>RINEX 2.11、3.xまたは4.xの観測ファイルです。通常形式でも圧縮（Hatanaka）形式でもよく、gzipまたはbzip2で圧縮されていてもかまいません。1ファイルを1走行とします。</translation>
    </message>
    <message>
        <source>Observations (*.obs *.rnx *.crx *.??o *.??O *.??d *.??D *.gz *.Z *.bz2)</source>
        <translation>観測データ (*.obs *.rnx *.crx *.??o *.??O *.??d *.??D *.gz *.Z *.bz2)</translation>
    </message>
    <message>
        <source>Navigation</source>
        <translation>航法データ</translation>
    </message>
    <message>
        <source>RINEX navigation files or SP3 orbits of the same days.</source>
        <translation>同じ日のRINEX航法ファイルまたはSP3軌道。</translation>
    </message>
    <message>
        <source>Navigation and orbits (*.nav *.rnx *.sp3 *.SP3 *.??n *.??N *.??p *.??P *.gz *.Z *.bz2)</source>
        <translation>航法データと軌道暦 (*.nav *.rnx *.sp3 *.SP3 *.??n *.??N *.??p *.??P *.gz *.Z *.bz2)</translation>
    </message>
    <message>
        <source>Geoid separation</source>
        <translation>ジオイド高</translation>
    </message>
    <message>
        <source>Ellipsoidal height minus the trajectory's height; 0 where the trajectory has ellipsoidal heights. Left empty, it is estimated from the satellites.</source>
        <translation>楕円体高から軌跡の高さを引いた値です。軌跡が楕円体高の場合は0とします。空欄の場合は衛星から推定します。</translation>
    </message>
    <message>
        <source>Elevation mask</source>
        <translation>仰角マスク</translation>
    </message>
    <message>
        <source>Satellites lower than this are left out.</source>
        <translation>これより低い衛星は除きます。</translation>
    </message>
    <message>
        <source>Lever arm of the antenna</source>
        <translation>アンテナのレバーアーム</translation>
    </message>
    <message>
        <source>Antenna in the vehicle's body: forward, right, down, in metres from the trajectory's origin.</source>
        <translation>車体座標系でのアンテナ位置: 軌跡の原点からの前方、右、下（メートル）。</translation>
    </message>
    <message>
        <source>Field with the building</source>
        <translation>建物のフィールド</translation>
    </message>
    <message>
        <source>Features with the same value are one building. Left empty, building_id or building is taken where it exists.</source>
        <translation>同じ値の地物を1つの建物とします。空欄の場合、building_idまたはbuildingがあれば使用します。</translation>
    </message>
    <message>
        <source>Field with the height of the top</source>
        <translation>上端の高さのフィールド</translation>
    </message>
    <message>
        <source>Height of the top of the walls, m, in the trajectory's heights. Needed for outlines without heights; z_top is found by itself.</source>
        <translation>壁面上端の高さ（m）で、軌跡と同じ高さの基準とします。高さのない外周線に必要です。z_topは自動的に検出します。</translation>
    </message>
    <message>
        <source>Field with the height of the foot</source>
        <translation>下端の高さのフィールド</translation>
    </message>
    <message>
        <source>Height of the foot of the walls, m; without it the walls of outlines reach down without end. z_base is found by itself.</source>
        <translation>壁面下端の高さ（m）です。ない場合、外周線の壁面は下方に限りなく延びるものとします。z_baseは自動的に検出します。</translation>
    </message>
    <message>
        <source>Maximum range of reflections</source>
        <translation>反射の最大距離</translation>
    </message>
    <message>
        <source>Walls farther from the antenna than this reflect nothing that is received, m.</source>
        <translation>アンテナからこれ（m）より遠い壁面からの反射信号は受信されないものとします。</translation>
    </message>
    <message>
        <source>Satellite systems</source>
        <translation>衛星システム</translation>
    </message>
    <message>
        <source>Letters of those that are used: G GPS, R GLONASS, E Galileo, C BeiDou, J QZSS.</source>
        <translation>使用するシステムの文字: G GPS、R GLONASS、E Galileo、C BeiDou、J QZSS。</translation>
    </message>
    <message>
        <source>Ionosphere by two bands</source>
        <translation>2周波による電離層補正</translation>
    </message>
    <message>
        <source>Measure the ionosphere where the receiver has codes on two bands; otherwise, or without them, the model that the satellites broadcast is taken.</source>
        <translation>受信機が2つの周波数のコードを持つ場合は、その差から電離層遅延を測定します。オフの場合や1周波のみの場合は、衛星が放送するモデルを使います。</translation>
    </message>
    <message>
        <source>Minimum number of passes</source>
        <translation>最小走行数</translation>
    </message>
    <message>
        <source>Walls seen in fewer observation files stay.</source>
        <translation>これより少ない観測ファイルにしか現れない壁面は動かしません。</translation>
    </message>
    <message>
        <source>Minimum number of observations</source>
        <translation>最小観測数</translation>
    </message>
    <message>
        <source>Walls with fewer independent observations are not adjusted, at most likely.</source>
        <translation>独立な観測がこれより少ない壁は調整せず、推定にとどめます。</translation>
    </message>
    <message>
        <source>Minimum number of satellites</source>
        <translation>最小衛星数</translation>
    </message>
    <message>
        <source>Walls seen by fewer satellites are not adjusted, at most likely.</source>
        <translation>観測した衛星がこれより少ない壁は調整せず、推定にとどめます。</translation>
    </message>
    <message>
        <source>Walls whose offset has a larger standard deviation are not adjusted, at most likely.</source>
        <translation>移動量の標準偏差がこれより大きい壁は調整せず、推定にとどめます。</translation>
    </message>
    <message>
        <source>Maximum sigma of likely walls</source>
        <translation>推定の壁の標準偏差の上限</translation>
    </message>
    <message>
        <source>Walls that are not adjusted are likely, and moved, up to this standard deviation; 0: they stay.</source>
        <translation>調整に至らない壁も、標準偏差がこの値以下なら推定として動かします。0なら動かしません。</translation>
    </message>
    <message>
        <source>Expected offset</source>
        <translation>想定オフセット</translation>
    </message>
    <message>
        <source>How far walls are off before anything is measured (standard deviation).</source>
        <translation>計測前に想定する壁面のずれ（標準偏差）です。</translation>
    </message>
    <message>
        <source>Adjusted buildings</source>
        <translation>調整後の建物</translation>
    </message>
    <message>
        <source>The buildings with their fields, and walls_adjusted (number of walls moved by their own observations) and walls_moved_by (m, largest).</source>
        <translation>元のフィールドに、walls_adjusted（自身の観測で移動した壁面の数）とwalls_moved_by（最大移動量、m）を加えた建物。</translation>
    </message>
    <message>
        <source>LineStringZ where each wall now stands: building, edge, status (adjusted, likely, not observable, held), reason why it is not adjusted, offset and sigma (m, outwards), applied (m moved), observations, signals, satellites, passes, on_time (share of the observations that are neither NLOS-delayed nor outliers), distance (m to the nearest antenna), length, low, top (m).</source>
        <translation>各壁の現在位置（LineStringZ）：建物、辺、状態（調整・推定・観測不能・保留）、調整しない理由、移動量と標準偏差（m、外向き）、動かした量（m）、観測数、信号数、衛星数、パス数、on_time（遅延でも外れ値でもない観測の割合）、距離（最も近いアンテナまで、m）、長さ、下端、上端（m）。</translation>
    </message>
    <message>
        <source>HTML report: sky plot, residuals by class against prediction, walls before and after, what to distrust.</source>
        <translation>HTML報告書: 天空図、予測に対する区分別の残差、調整前後の壁面、注意すべき点。</translation>
    </message>
    <message>
        <source>Number of walls.</source>
        <translation>壁面の数です。</translation>
    </message>
    <message>
        <source>Walls whose own observations decide where they stand.</source>
        <translation>自らの観測で位置が決まった壁の数。</translation>
    </message>
    <message>
        <source>Adjusted</source>
        <translation>調整済み</translation>
    </message>
    <message>
        <source>Walls that were moved by observations that are few or contradict each other.</source>
        <translation>観測が少ない、または食い違うが、推定として動かした壁の数。</translation>
    </message>
    <message>
        <source>Likely</source>
        <translation>推定</translation>
    </message>
    <message>
        <source>Independent observations of all walls.</source>
        <translation>全壁面の独立な観測です。</translation>
    </message>
    <message>
        <source>Observations used</source>
        <translation>使用した観測</translation>
    </message>
    <message>
        <source>Observation files with usable signals.</source>
        <translation>使用可能な信号を含む観測ファイルです。</translation>
    </message>
    <message>
        <source>Of the offsets of the adjusted walls.</source>
        <translation>調整した壁面のオフセットの値です。</translation>
    </message>
    <message>
        <source>Size of the offsets of the adjusted walls.</source>
        <translation>調整した壁面のオフセットの大きさです。</translation>
    </message>
    <message>
        <source>Median offset</source>
        <translation>オフセットの中央値</translation>
    </message>
    <message>
        <source>Adjust walls by GNSS</source>
        <translation>GNSSによる壁面の調整</translation>
    </message>
    <message>
        <source>Seconds between lines</source>
        <translation>線の時間間隔</translation>
    </message>
    <message>
        <source>s</source>
        <translation>s</translation>
    </message>
    <message>
        <source>Lines are drawn of epochs this far apart; figures are those of all.</source>
        <translation>この間隔のエポックについて線を描きます。数値は全エポックのものです。</translation>
    </message>
    <message>
        <source>Length of the lines</source>
        <translation>線の長さ</translation>
    </message>
    <message>
        <source>Of the part towards the satellite.</source>
        <translation>衛星に向かう部分の長さです。</translation>
    </message>
    <message>
        <source>Rays</source>
        <translation>信号経路</translation>
    </message>
    <message>
        <source>LineStringZ: time, pass, satellite, system, kind (LOS, NLOS, reflected), sure, elevation, azimuth (degrees, from grid north), cn0, excess (predicted excess path, m), residual (m), difference (residual minus excess), reflections (number of walls that can have reflected it), building, edge (of the wall).</source>
        <translation>LineStringZ: time、pass、satellite、system、kind（LOS、NLOS、reflected）、sure、elevation、azimuth（度、座標北から）、cn0、excess（予測した過剰経路長、m）、residual（m）、difference（residualからexcessを引いた値）、reflections（反射した可能性のある壁面の数）、building、edge（壁面の辺）。</translation>
    </message>
    <message>
        <source>HTML report: sky plot, residuals by class against prediction, what to distrust.</source>
        <translation>HTML報告書: 天空図、予測に対する区分別の残差、注意すべき点。</translation>
    </message>
    <message>
        <source>Number of signals.</source>
        <translation>信号の数です。</translation>
    </message>
    <message>
        <source>Signals</source>
        <translation>信号</translation>
    </message>
    <message>
        <source>In line of sight</source>
        <translation>見通し内(LOS)</translation>
    </message>
    <message>
        <source>Number of signals without a single wall to reflect them.</source>
        <translation>反射し得る壁面が1つもない信号の数です。</translation>
    </message>
    <message>
        <source>Blocked</source>
        <translation>遮断</translation>
    </message>
    <message>
        <source>Reflected</source>
        <translation>反射</translation>
    </message>
    <message>
        <source>After the receiver's clock.</source>
        <translation>受信機時計誤差を除いた後の値です。</translation>
    </message>
    <message>
        <source>Median residual in line of sight</source>
        <translation>見通し内(LOS)の残差の中央値</translation>
    </message>
    <message>
        <source>Of the residuals.</source>
        <translation>残差の値です。</translation>
    </message>
    <message>
        <source>Quartile range in line of sight</source>
        <translation>見通し内(LOS)の四分位範囲</translation>
    </message>
    <message>
        <source>Share of the reflected signals within 5 m of prediction.</source>
        <translation>反射信号のうち、予測との差が5 m以内のものの割合です。</translation>
    </message>
    <message>
        <source>Within 5 m</source>
        <translation>5 m以内</translation>
    </message>
    <message>
        <source>Share of the reflected signals within 10 m of prediction.</source>
        <translation>反射信号のうち、予測との差が10 m以内のものの割合です。</translation>
    </message>
    <message>
        <source>Within 10 m</source>
        <translation>10 m以内</translation>
    </message>
    <message>
        <source>GNSS reflections</source>
        <translation>GNSS反射</translation>
    </message>
    <message>
        <source>RINEX navigation files or SP3 orbits of the day.</source>
        <translation>当日のRINEX航法ファイルまたはSP3軌道。</translation>
    </message>
    <message>
        <source>Drives along which to count, in the CRS of the buildings: CSV time,x,y,z,roll,pitch,heading, SBET, or point layers. Left empty, an area is filled.</source>
        <translation>衛星数を求める走行。座標参照系は建物と同じとします: CSV time,x,y,z,roll,pitch,heading、SBET、または点レイヤ。空欄の場合は領域全体について求めます。</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>時刻</translation>
    </message>
    <message>
        <source>Time in UTC for an area, such as 2024-04-18 02:30:00; a trajectory has times of its own.</source>
        <translation>領域について求める場合の時刻（UTC）です（例: 2024-04-18 02:30:00）。軌跡の場合は軌跡自身の時刻を用います。</translation>
    </message>
    <message>
        <source>Area to fill where no trajectory is given; left empty, that of the buildings.</source>
        <translation>軌跡を指定しない場合に対象とする領域です。空欄の場合は建物の範囲とします。</translation>
    </message>
    <message>
        <source>Distance in metres between the places in an area.</source>
        <translation>領域内の地点の間隔（メートル）です。</translation>
    </message>
    <message>
        <source>Heights of the ground in metres, for an area. Without it the ground is level at the feet of the buildings.</source>
        <translation>領域について求める場合の地表の標高（メートル）。ない場合は、地表を建物の下端の高さで水平とします。</translation>
    </message>
    <message>
        <source>Height of the antenna</source>
        <translation>アンテナ高</translation>
    </message>
    <message>
        <source>Above the ground, in metres, for an area.</source>
        <translation>領域について求める場合の、地表からの高さ（メートル）です。</translation>
    </message>
    <message>
        <source>Seconds between places</source>
        <translation>地点の時間間隔</translation>
    </message>
    <message>
        <source>Along a trajectory.</source>
        <translation>軌跡に沿った間隔です。</translation>
    </message>
    <message>
        <source>Satellites lower than this are not counted.</source>
        <translation>これより低い衛星は数えません。</translation>
    </message>
    <message>
        <source>Letters of those that are counted: G GPS, R GLONASS, E Galileo, C BeiDou, J QZSS.</source>
        <translation>数えるシステムの文字: G GPS、R GLONASS、E Galileo、C BeiDou、J QZSS。</translation>
    </message>
    <message>
        <source>Visible satellites</source>
        <translation>可視衛星</translation>
    </message>
    <message>
        <source>PointZ: time (of the trajectory, or GPS seconds), satellites (in line of sight), gps, glonass, galileo, beidou, qzss (of them), above (satellites above the mask, hidden ones too), pdop.</source>
        <translation>PointZ: time（軌跡の時刻、またはGPS秒）、satellites（見通し内(LOS)の数）、gps、glonass、galileo、beidou、qzss（その内訳）、above（マスクより上の衛星、遮蔽されたものを含む）、pdop。</translation>
    </message>
    <message>
        <source>Visible satellites over the area</source>
        <translation>領域の可視衛星</translation>
    </message>
    <message>
        <source>Number of satellites in line of sight; no value inside buildings. Only without a trajectory.</source>
        <translation>見通し内(LOS)の衛星数。建物内は値なし。軌跡を指定しない場合に限ります。</translation>
    </message>
    <message>
        <source>Satellites in line of sight, mean over the places.</source>
        <translation>見通し内(LOS)の衛星数の、全地点の平均です。</translation>
    </message>
    <message>
        <source>Mean</source>
        <translation>平均</translation>
    </message>
    <message>
        <source>Share of the places with fewer than four satellites in line of sight, 0 to 1.</source>
        <translation>見通し内(LOS)の衛星が4機未満の地点の割合、0～1。</translation>
    </message>
    <message>
        <source>Share below four</source>
        <translation>4機未満の割合</translation>
    </message>
    <message>
        <source>Share of the places where the satellites in line of sight fix no position, 0 to 1.</source>
        <translation>見通し内(LOS)の衛星では位置が決まらない地点の割合、0～1。</translation>
    </message>
    <message>
        <source>Share without a position</source>
        <translation>測位不能の割合</translation>
    </message>
    <message>
        <source>Number of different satellites above the mask.</source>
        <translation>マスクより上の異なる衛星の数です。</translation>
    </message>
    <message>
        <source>Satellites</source>
        <translation>衛星</translation>
    </message>
    <message>
        <source>Lanelet2 (*.osm)</source>
        <translation>Lanelet2 (*.osm)</translation>
    </message>
    <message>
        <source>Old map: Lanelet2 file</source>
        <translation>旧地図：Lanelet2 ファイル</translation>
    </message>
    <message>
        <source>OSM file; or give lines.</source>
        <translation>OSM ファイル。または線を与えます。</translation>
    </message>
    <message>
        <source>Old map: lines</source>
        <translation>旧地図：線</translation>
    </message>
    <message>
        <source>Lines with the field class, in place of a Lanelet2 file: marking lines or bounds of lanes; colour, sigma and double are used where they are there.</source>
        <translation>Lanelet2 ファイルの代わりに使う、属性 class のある線（標示の線または車線の境界線）。colour、sigma、double があれば使います。</translation>
    </message>
    <message>
        <source>Old map: areas</source>
        <translation>旧地図：面</translation>
    </message>
    <message>
        <source>Crosswalks and symbols of the map that is given as lines, with the field class.</source>
        <translation>線で与えた地図の横断歩道と記号（属性 class が必要）。</translation>
    </message>
    <message>
        <source>New map: Lanelet2 file</source>
        <translation>新地図：Lanelet2 ファイル</translation>
    </message>
    <message>
        <source>New map: lines</source>
        <translation>新地図：線</translation>
    </message>
    <message>
        <source>New map: areas</source>
        <translation>新地図：面</translation>
    </message>
    <message>
        <source>Area of both maps</source>
        <translation>両方の地図の範囲</translation>
    </message>
    <message>
        <source>What both maps show: within it everything counts, also roads that only one of them has; outside of it nothing is added or removed.</source>
        <translation>両方の地図が載せる範囲。その中では一方にしかない道路もすべて対象とし、外では追加・撤去としません。</translation>
    </message>
    <message>
        <source>Longest shift of a line</source>
        <translation>線の最大移動量</translation>
    </message>
    <message>
        <source>A line farther off is another one: the old one was removed, the new one added.</source>
        <translation>これより離れた線は別の線とみなし、旧の撤去と新の追加とします。</translation>
    </message>
    <message>
        <source>Shortest change of a line</source>
        <translation>線の変化の最短長</translation>
    </message>
    <message>
        <source>Shorter stretches of lines are not told.</source>
        <translation>これより短い区間は示しません。</translation>
    </message>
    <message>
        <source>Smallest shift</source>
        <translation>最小移動量</translation>
    </message>
    <message>
        <source>Smaller shifts are not told, also where they are significant.</source>
        <translation>これより小さい移動は、有意でも示しません。</translation>
    </message>
    <message>
        <source>Sigma of the old map</source>
        <translation>旧地図の標準偏差</translation>
    </message>
    <message>
        <source>Standard deviation of the places of elements that state none; left empty, it is estimated.</source>
        <translation>標準偏差のない要素の位置の標準偏差。空欄なら推定します。</translation>
    </message>
    <message>
        <source>Sigma of the new map</source>
        <translation>新地図の標準偏差</translation>
    </message>
    <message>
        <source>Changes</source>
        <translation>変化</translation>
    </message>
    <message>
        <source>Lines and outlines: kind (moved, added, removed, repainted, or offset of the whole map, without geometry), element, before and after (class and colour), length, shift, azimuth, along and across (m; across is to the left of the old element), sigma, significance (shift over sigma), ids in both maps.</source>
        <translation>線と輪郭。kind（moved 移動、added 追加、removed 撤去、repainted 塗り替え、offset 地図全体のずれ（形状なし））、element、before と after（種別と色）、length、shift、azimuth、along と across（m。across は旧要素の左方向）、sigma、significance（移動量÷標準偏差）、両方の地図の id。</translation>
    </message>
    <message>
        <source>HTML report: verdict, offset, table by kind and length, sigmas, map and list of the changes.</source>
        <translation>HTML 報告書：判定、全体のずれ、種類と長さの表、標準偏差、地図、変化の一覧。</translation>
    </message>
    <message>
        <source>Number of such changes.</source>
        <translation>その変化の数。</translation>
    </message>
    <message>
        <source>Moved</source>
        <translation>移動</translation>
    </message>
    <message>
        <source>Added</source>
        <translation>追加</translation>
    </message>
    <message>
        <source>Removed</source>
        <translation>撤去</translation>
    </message>
    <message>
        <source>Repainted</source>
        <translation>塗り替え</translation>
    </message>
    <message>
        <source>Of the new map against the old one; 0 where it is not significant.</source>
        <translation>旧地図に対する新地図のずれ。有意でなければ 0。</translation>
    </message>
    <message>
        <source>Offset to the east</source>
        <translation>東方向のずれ</translation>
    </message>
    <message>
        <source>The same to the north.</source>
        <translation>同じく北方向。</translation>
    </message>
    <message>
        <source>Offset to the north</source>
        <translation>北方向のずれ</translation>
    </message>
    <message>
        <source>Of the old map's lines that are as they were.</source>
        <translation>旧地図の線のうち変わっていないもの。</translation>
    </message>
    <message>
        <source>Same length</source>
        <translation>変化のない長さ</translation>
    </message>
    <message>
        <source>Of the old map's lines where the new map shows the road.</source>
        <translation>旧地図の線のうち、新地図に道路が載っているもの。</translation>
    </message>
    <message>
        <source>Compared length</source>
        <translation>比較した長さ</translation>
    </message>
    <message>
        <source>Compare lane maps</source>
        <translation>車線地図の新旧比較</translation>
    </message>
    <message>
        <source>Building models (MultiPolygonZ, such as those of “Building models”) or outlines with heights, in a projected CRS in metres. Leave them out to ask for markings alone.</source>
        <translation>建物モデル（「建物モデル」によるMultiPolygonZなど）、または高さをもつ外周線。メートル単位の投影座標系とします。路面標示だけで評価する場合は指定しません。</translation>
    </message>
    <message>
        <source>Walls with sigma</source>
        <translation>σ付きの壁面</translation>
    </message>
    <message>
        <source>Walls whose accuracy was measured (field sigma), such as those of “Merge building models” or “Adjust walls by GNSS”: walls of the buildings that run along them take their sigma.</source>
        <translation>「建物モデルと計測壁面の統合」や「GNSSによる壁面の調整」の結果など、精度（フィールドsigma）が求められた壁面。これに沿う建物の壁面はそのσを引き継ぎます。</translation>
    </message>
    <message>
        <source>Sigma of walls</source>
        <translation>壁面のσ</translation>
    </message>
    <message>
        <source>Standard deviation of the place of a wall across itself, where neither a field nor WALLS tell it.</source>
        <translation>フィールドにもWALLSにも値がない場合の、壁面に直交する方向の位置の標準偏差です。</translation>
    </message>
    <message>
        <source>Polygons or lines of markings, such as those of “Lines from road markings” (field sigma).</source>
        <translation>「路面標示からの線」の結果など、路面標示のポリゴンまたは線（フィールドsigma）。</translation>
    </message>
    <message>
        <source>Sigma of markings</source>
        <translation>路面標示のσ</translation>
    </message>
    <message>
        <source>Standard deviation of the place of a marking, where no field sigma tells it.</source>
        <translation>フィールドsigmaに値がない場合の、路面標示の位置の標準偏差です。</translation>
    </message>
    <message>
        <source>Common sigma of markings</source>
        <translation>路面標示の共通σ</translation>
    </message>
    <message>
        <source>Standard deviation of a displacement that the markings around a place share, such as that of the aerial block.</source>
        <translation>空中写真のブロックのずれなど、ある地点の周囲の路面標示に共通するずれの標準偏差です。</translation>
    </message>
    <message>
        <source>Lines along which vehicles drive, such as centre lines of lanes. A field tunnel (yes, 1) is heeded.</source>
        <translation>車線の中心線など、車両の走行する線。フィールドtunnel（yes、1）を考慮します。</translation>
    </message>
    <message>
        <source>Drives in the CRS of the buildings instead of roads.</source>
        <translation>道路の代わりに用いる走行。座標参照系は建物と同じとします。</translation>
    </message>
    <message>
        <source>Area to fill where neither roads nor trajectories are given; left empty, that of the map. Along is then north.</source>
        <translation>道路も軌跡も指定しない場合に対象とする領域です。空欄の場合は地図の範囲とします。このとき縦方向は北とします。</translation>
    </message>
    <message>
        <source>Spacing</source>
        <translation>間隔</translation>
    </message>
    <message>
        <source>Distance between the places.</source>
        <translation>地点間の距離です。</translation>
    </message>
    <message>
        <source>Heights of the ground in metres. Without it the roads' heights are taken, or the feet of the buildings beside them.</source>
        <translation>地表の標高（メートル）。ない場合は道路の高さ、または道路脇の建物の下端の高さを用います。</translation>
    </message>
    <message>
        <source>Features with the same value are one building.</source>
        <translation>同じ値の地物を1つの建物とします。</translation>
    </message>
    <message>
        <source>m; z_top and top are found by themselves.</source>
        <translation>m。z_topとtopは自動的に検出します。</translation>
    </message>
    <message>
        <source>m; z_base and ground are found by themselves.</source>
        <translation>m。z_baseとgroundは自動的に検出します。</translation>
    </message>
    <message>
        <source>Field with the sigma of walls</source>
        <translation>壁面のσのフィールド</translation>
    </message>
    <message>
        <source>Of a building's walls, m; wall_sigma and sigma_xy are found by themselves.</source>
        <translation>建物の壁面のσ（m）です。wall_sigmaとsigma_xyは自動的に検出します。</translation>
    </message>
    <message>
        <source>RINEX navigation files or SP3 orbits: then satellites count too.</source>
        <translation>RINEX航法ファイルまたはSP3軌道。指定すると衛星も考慮します。</translation>
    </message>
    <message>
        <source>Time in UTC for roads and areas, such as 2024-04-18 02:30:00; left empty, six times over the hours of the navigation files. A trajectory has times of its own.</source>
        <translation>道路または領域の場合の時刻（UTC）です（例: 2024-04-18 02:30:00）。空欄の場合は、航法ファイルの時間帯にわたる6時刻とします。軌跡の場合は軌跡自身の時刻を用います。</translation>
    </message>
    <message>
        <source>Satellites lower than this are not used.</source>
        <translation>これより低い衛星は使用しません。</translation>
    </message>
    <message>
        <source>G GPS, R GLONASS, E Galileo, C BeiDou, J QZSS.</source>
        <translation>G GPS、R GLONASS、E Galileo、C BeiDou、J QZSS。</translation>
    </message>
    <message>
        <source>Scanner</source>
        <translation>スキャナ</translation>
    </message>
    <message>
        <source>one layer (2D)</source>
        <translation>1層（2D）</translation>
    </message>
    <message>
        <source>several layers</source>
        <translation>多層</translation>
    </message>
    <message>
        <source>Of the vehicle to be localised. (2D, multi-layer)</source>
        <translation>自己位置を推定する車両のスキャナです。(2D, multi-layer)</translation>
    </message>
    <message>
        <source>Range of the scanner</source>
        <translation>スキャナの測距範囲</translation>
    </message>
    <message>
        <source>Walls farther away are not seen.</source>
        <translation>これより遠い壁面は見えないものとします。</translation>
    </message>
    <message>
        <source>Height of the scanner</source>
        <translation>スキャナの高さ</translation>
    </message>
    <message>
        <source>Above the road.</source>
        <translation>路面からの高さです。</translation>
    </message>
    <message>
        <source>Matching</source>
        <translation>照合方法</translation>
    </message>
    <message>
        <source>How scans are matched to the map. (NDT, ICP)</source>
        <translation>スキャンを地図に照合する方法です。(NDT, ICP)</translation>
    </message>
    <message>
        <source>Angular resolution</source>
        <translation>角度分解能</translation>
    </message>
    <message>
        <source>Between rays of a layer.</source>
        <translation>1つの層の中の光線の間隔です。</translation>
    </message>
    <message>
        <source>Noise of ranges</source>
        <translation>測距ノイズ</translation>
    </message>
    <message>
        <source>Standard deviation.</source>
        <translation>標準偏差です。</translation>
    </message>
    <message>
        <source>Layers</source>
        <translation>層数</translation>
    </message>
    <message>
        <source>Of a multi-layer scanner.</source>
        <translation>多層スキャナの層の数です。</translation>
    </message>
    <message>
        <source>Lowest layer</source>
        <translation>最下層</translation>
    </message>
    <message>
        <source>Its elevation.</source>
        <translation>その仰角です。</translation>
    </message>
    <message>
        <source>Highest layer</source>
        <translation>最上層</translation>
    </message>
    <message>
        <source>Share of hidden rays</source>
        <translation>遮られる光線の割合</translation>
    </message>
    <message>
        <source>Rays that end at vehicles, trees or people.</source>
        <translation>車両、樹木、人などで止まる光線です。</translation>
    </message>
    <message>
        <source>Cells of the NDT</source>
        <translation>NDTのセル</translation>
    </message>
    <message>
        <source>Common sigma of a building</source>
        <translation>建物の共通σ</translation>
    </message>
    <message>
        <source>Standard deviation of a displacement that all walls of a building share.</source>
        <translation>1棟の建物の全壁面に共通するずれの標準偏差です。</translation>
    </message>
    <message>
        <source>Sigma before matching</source>
        <translation>照合前のσ</translation>
    </message>
    <message>
        <source>What is known before, of east and of north: a direction without evidence keeps it.</source>
        <translation>照合前に分かっている東方向と北方向の精度です。手がかりのない方向ではこの値のままとなります。</translation>
    </message>
    <message>
        <source>Sigma of the heading before matching</source>
        <translation>照合前の方位角のσ</translation>
    </message>
    <message>
        <source>Search for repetitions</source>
        <translation>類似地点の探索範囲</translation>
    </message>
    <message>
        <source>Places that look alike are searched for within this distance; 0: not at all.</source>
        <translation>この距離の範囲で、よく似た地点を探します。0の場合は探しません。</translation>
    </message>
    <message>
        <source>Range of markings</source>
        <translation>路面標示の検出距離</translation>
    </message>
    <message>
        <source>Markings farther away are not seen.</source>
        <translation>これより遠い路面標示は見えないものとします。</translation>
    </message>
    <message>
        <source>View of markings</source>
        <translation>路面標示の視野角</translation>
    </message>
    <message>
        <source>Angle ahead in which markings are seen: 360 for the intensity of a scanner around, about 100 for a camera.</source>
        <translation>路面標示が見える前方の角度です。全周スキャナの反射強度では360、カメラでは約100とします。</translation>
    </message>
    <message>
        <source>Detection rate of markings</source>
        <translation>路面標示の検出率</translation>
    </message>
    <message>
        <source>Share of the markings within sight that are found.</source>
        <translation>視野内の路面標示のうち、検出されるものの割合です。</translation>
    </message>
    <message>
        <source>Sigma of satellite ranges</source>
        <translation>衛星測距のσ</translation>
    </message>
    <message>
        <source>Standard deviation of a code range at the zenith.</source>
        <translation>天頂でのコード距離の標準偏差です。</translation>
    </message>
    <message>
        <source>Share of reflected signals</source>
        <translation>反射信号の割合</translation>
    </message>
    <message>
        <source>Of the hidden satellites those that are received by reflection and used.</source>
        <translation>遮蔽された衛星のうち、反射により受信され使用されるものの割合です。</translation>
    </message>
    <message>
        <source>Limit of good</source>
        <translation>「良」の限界値</translation>
    </message>
    <message>
        <source>Largest sigma of the weakest direction of a good place.</source>
        <translation>「良」とする地点での、最も弱い方向のσの上限です。</translation>
    </message>
    <message>
        <source>Limit of usable</source>
        <translation>「可」の限界値</translation>
    </message>
    <message>
        <source>The same of a usable place.</source>
        <translation>「可」とする地点での同じ値です。</translation>
    </message>
    <message>
        <source>Simulate scans</source>
        <translation>スキャンのシミュレーション</translation>
    </message>
    <message>
        <source>Scans are simulated at some places and registered to the map: observed against predicted accuracy in the report and among the results.</source>
        <translation>いくつかの地点でスキャンをシミュレートして地図に位置合わせし、実際の精度と予測精度の比較を報告書と結果に示します。</translation>
    </message>
    <message>
        <source>Simulate every</source>
        <translation>シミュレーションの間隔</translation>
    </message>
    <message>
        <source>At every so many places that see walls.</source>
        <translation>壁面の見える地点について、この数ごとに行います。</translation>
    </message>
    <message>
        <source>Scans a place</source>
        <translation>1地点当たりのスキャン数</translation>
    </message>
    <message>
        <source>Each in another true city, as the sigmas of the walls allow.</source>
        <translation>スキャンごとに、壁面のσの範囲で異なる真の都市を用います。</translation>
    </message>
    <message>
        <source>True buildings</source>
        <translation>真の建物</translation>
    </message>
    <message>
        <source>The true city to simulate in, with heights as BUILDINGS has them; without it the map is displaced by its sigmas.</source>
        <translation>シミュレーションに用いる真の都市で、高さはBUILDINGSと同じ形式とします。ない場合は地図をそのσに従ってずらします。</translation>
    </message>
    <message>
        <source>Of the simulation.</source>
        <translation>シミュレーションの値です。</translation>
    </message>
    <message>
        <source>Localisation accuracy</source>
        <translation>自己位置推定の精度</translation>
    </message>
    <message>
        <source>Points along the roads: sigma_along, sigma_across (m), sigma_heading (degrees) together, and of each source (…_walls, …_markings, …_satellites); major, minor (m) and weakest (bearing of the major axis) of the error ellipse; undetermined (directions that keep what was known before) and elsewhere (share of scans that end beside the place); alias_share, alias_distance, alias_bearing; points, n_walls, horizon and sky (share with walls), cell_rms, two_surfaces, satellites, pdop; class and status.</source>
        <translation>道路に沿った点: すべてを合わせたsigma_along、sigma_across（m）、sigma_heading（度）と、情報源ごとの値（…_walls、…_markings、…_satellites）。誤差楕円のmajor、minor（m）とweakest（長軸の方位角）。undetermined（照合前の値のままの方向の数）とelsewhere（別の場所に収束するスキャンの割合）。alias_share、alias_distance、alias_bearing。points、n_walls、horizonとsky（壁面のある割合）、cell_rms、two_surfaces、satellites、pdop。classとstatus。</translation>
    </message>
    <message>
        <source>Localisation accuracy, raster</source>
        <translation>自己位置推定の精度（ラスタ）</translation>
    </message>
    <message>
        <source>Sigma of the weakest direction, m, in cells of the spacing.</source>
        <translation>最も弱い方向のσ（m）。セルの大きさは地点の間隔と同じです。</translation>
    </message>
    <message>
        <source>Road by class, the worst stretches with pictures, and what was simulated.</source>
        <translation>区分別の道路、最も精度の悪い区間とその図、シミュレーションの結果。</translation>
    </message>
    <message>
        <source>Number of places.</source>
        <translation>地点の数です。</translation>
    </message>
    <message>
        <source>Places</source>
        <translation>地点</translation>
    </message>
    <message>
        <source>Of the weakest direction, over the places that have one.</source>
        <translation>最も弱い方向の値で、値のある全地点についてのものです。</translation>
    </message>
    <message>
        <source>Road of class good.</source>
        <translation>区分good（良）の道路です。</translation>
    </message>
    <message>
        <source>Length of good road</source>
        <translation>「良」の道路の延長</translation>
    </message>
    <message>
        <source>Road of class usable.</source>
        <translation>区分usable（可）の道路です。</translation>
    </message>
    <message>
        <source>Length of usable road</source>
        <translation>「可」の道路の延長</translation>
    </message>
    <message>
        <source>Road of class poor.</source>
        <translation>区分poor（不良）の道路です。</translation>
    </message>
    <message>
        <source>Length of poor road</source>
        <translation>「不良」の道路の延長</translation>
    </message>
    <message>
        <source>Road of which nothing can be said.</source>
        <translation>精度を判定できない道路です。</translation>
    </message>
    <message>
        <source>Length of road without</source>
        <translation>判定不能の道路の延長</translation>
    </message>
    <message>
        <source>Number of places that look like others.</source>
        <translation>ほかの地点とよく似た地点の数です。</translation>
    </message>
    <message>
        <source>Repeated places</source>
        <translation>類似地点</translation>
    </message>
    <message>
        <source>Of observed and predicted errors, where scans were simulated.</source>
        <translation>スキャンをシミュレートした場合の、実際の誤差と予測誤差との相関です。</translation>
    </message>
    <message>
        <source>Spearman's coefficient</source>
        <translation>スピアマンの順位相関係数</translation>
    </message>
    <message>
        <source>Of simulated errors within the 95 % ellipse.</source>
        <translation>シミュレーションの誤差のうち、95 %楕円に入るものの割合です。</translation>
    </message>
    <message>
        <source>Share within the ellipse</source>
        <translation>楕円内の割合</translation>
    </message>
    <message>
        <source>Map of localisation accuracy</source>
        <translation>自己位置推定精度の地図</translation>
    </message>
    <message>
        <source>Polygons of the markings, such as those of “Road markings from orthophoto”, in a projected CRS in metres. A field colour (white, yellow) is used where there is one.</source>
        <translation>「オルソ画像からの路面標示」の結果など、路面標示のポリゴン。メートル単位の投影座標系とします。フィールドcolour（white、yellow）があれば使用します。</translation>
    </message>
    <message>
        <source>Heights of the ground in metres, in the CRS of the markings: gives lines and areas their heights.</source>
        <translation>地表の標高（メートル）。座標参照系は路面標示と同じとします。線と面に高さを与えます。</translation>
    </message>
    <message>
        <source>Standard deviation of the markings</source>
        <translation>路面標示の標準偏差</translation>
    </message>
    <message>
        <source>How well the places of the markings are known as a whole, in metres; it enters the lines' sigma.</source>
        <translation>路面標示全体の位置の精度（メートル）です。線のσに含まれます。</translation>
    </message>
    <message>
        <source>LAS, LAZ or COPC files of “Road markings of a mobile survey”, from a corrected survey. They show paint that vehicles, trees or shadows hide from the air: what the polygons do not show is added to them. Without polygons they are all the paint.</source>
        <translation>補正済みの計測に対する「MMS計測の路面標示」のLAS、LAZ、COPCファイル。車両、樹木、影で上空から隠れた標示を補います。ポリゴンにない分が加わります。ポリゴンがなければ、これがすべての標示になります。</translation>
    </message>
    <message>
        <source>Minimum line length</source>
        <translation>線の最小長</translation>
    </message>
    <message>
        <source>Shorter lines are left out.</source>
        <translation>これより短い線は除きます。</translation>
    </message>
    <message>
        <source>Maximum line width</source>
        <translation>線の最大幅</translation>
    </message>
    <message>
        <source>Wider strokes are no part of a line.</source>
        <translation>これより幅の広いものは線の一部としません。</translation>
    </message>
    <message>
        <source>Marking lines</source>
        <translation>路面標示の線</translation>
    </message>
    <message>
        <source>Lines, with heights where a ground is given: class (solid, dashed, stop line, guiding strip), colour, width and width_sigma (m, of the paint; by marking points, or empty where nothing tells it to 3 cm), sigma (m, across), length (m), bridged (m without paint that should be there), period and dash (m), dashes (begins and ends along the line, m), chain (sections of one line), partner (chain that makes it a double line), confidence (0 to 1: share of the paint that should be there and is seen; of a stop line less where only lines' ends or only a crosswalk show it), placed (ends among the dashes' that are worn and lie where whole dashes ask for them, m), sigmas (m, at each vertex, growing with the distance to the paint).</source>
        <translation>ライン（地盤を与えれば高さ付き）：class（solid、dashed、stop line、guiding strip）、colour、width と width_sigma（標示の幅とその標準偏差 m。マーキング点群による。3 cm の精度で決められなければ空欄）、sigma（横方向、m）、length（m）、bridged（あるべき標示のない長さ m）、period と dash（m）、dashes（線に沿った始点と終点 m）、chain（一続きの線の区間）、partner（二重線の相手の chain）、confidence（0～1：あるべき標示のうち見えた割合。停止線は線の端または横断歩道だけが示す場合は小さい）、placed（摩耗していて、揃った破線から位置を定めた端 m）、sigmas（各頂点の標準偏差 m、標示から離れるほど大きい）。</translation>
    </message>
    <message>
        <source>Marking areas</source>
        <translation>路面標示の面</translation>
    </message>
    <message>
        <source>Polygons: class (crosswalk; arrow straight, ..., or arrow, kind unknown; diamond; unknown), colour, heading (degrees from grid north in which it is read), score (0 to 1: agreement with the shape; of a crosswalk paint at its bars' places less that between them).</source>
        <translation>ポリゴン: class（crosswalk 横断歩道、arrow straight 直進矢印 ...、種類不明の場合はarrow、diamond ひし形、unknown 不明）、colour、heading（読む向き、座標北からの度）、score（0～1: 形状との一致度。横断歩道では縞の位置の標示から縞の間の標示を引いた値）。</translation>
    </message>
    <message>
        <source>Number of lines.</source>
        <translation>線の数です。</translation>
    </message>
    <message>
        <source>Lines</source>
        <translation>線</translation>
    </message>
    <message>
        <source>Length of all lines.</source>
        <translation>全線の延長です。</translation>
    </message>
    <message>
        <source>Length</source>
        <translation>長さ</translation>
    </message>
    <message>
        <source>Number of crosswalks.</source>
        <translation>横断歩道の数です。</translation>
    </message>
    <message>
        <source>Crosswalks</source>
        <translation>横断歩道</translation>
    </message>
    <message>
        <source>Share of the area of the markings that is neither line nor known shape, 0 to 1.</source>
        <translation>路面標示の面積のうち、線でも既知の形状でもないものの割合、0～1。</translation>
    </message>
    <message>
        <source>Unknown paint</source>
        <translation>不明な標示</translation>
    </message>
    <message>
        <source>The survey, placed by the trajectory: LAS, LAZ or COPC files with GPS times, in one projected coordinate system.</source>
        <translation>軌跡により座標付けした計測: GPS時刻をもつLAS、LAZまたはCOPCファイル。1つの投影座標系とします。</translation>
    </message>
    <message>
        <source>Heights of the ground in metres, from which those of the points are counted. Without it the ground is found among the points; where the raster has no value no edge is found.</source>
        <translation>点の高さの基準とする地表の標高（メートル）。ない場合は点群から地表を求めます。ラスタに値のない場所では道路端を検出しません。</translation>
    </message>
    <message>
        <source>Half width</source>
        <translation>片側の幅</translation>
    </message>
    <message>
        <source>Edges up to so far from the path, in metres.</source>
        <translation>走行経路からこの距離（メートル）までの道路端を対象とします。</translation>
    </message>
    <message>
        <source>Lowest kerb</source>
        <translation>縁石の最小高さ</translation>
    </message>
    <message>
        <source>Lower steps, in metres, are no kerbs; between two parts of a kerb they are its lowered places.</source>
        <translation>これ（メートル）より低い段差は縁石としません。ただし縁石と縁石の間では、切下げ部とみなします。</translation>
    </message>
    <message>
        <source>Highest kerb</source>
        <translation>縁石の最大高さ</translation>
    </message>
    <message>
        <source>Higher steps, in metres, are no kerbs.</source>
        <translation>これ（メートル）より高い段差は縁石としません。</translation>
    </message>
    <message>
        <source>Shorter edges, in metres, are left out.</source>
        <translation>これ（メートル）より短い道路端は除きます。</translation>
    </message>
    <message>
        <source>Standard deviation of the survey</source>
        <translation>計測の標準偏差</translation>
    </message>
    <message>
        <source>How well the survey is placed as a whole, in metres; it enters the sigma of all edges.</source>
        <translation>計測全体の位置の精度（メートル）です。すべての道路端のσに含まれます。</translation>
    </message>
    <message>
        <source>Objects of “Objects from images” for the GeoPackage.</source>
        <translation>GeoPackageに入れる「画像からの地物」の地物。</translation>
    </message>
    <message>
        <source>Walls of “Walls from a mobile survey” for the GeoPackage.</source>
        <translation>GeoPackageに入れる「MMS計測の壁面」の壁面。</translation>
    </message>
    <message>
        <source>Road edges</source>
        <translation>道路端</translation>
    </message>
    <message>
        <source>LineStringZ along the foot: edge_id, kind (kerb, lowered kerb, road border, guard rail, wall), height, sigma (across), sigma_z, length (m), points, passes, completeness (share of the line that was measured), chain (parts of one edge), gap (m to the next part), status (measured, doubtful), reason.</source>
        <translation>下端に沿ったLineStringZ: edge_id、kind（kerb 縁石、lowered kerb 縁石の切下げ部、road border 道路境界、guard rail ガードレール、wall 壁面）、height、sigma（横断方向）、sigma_z、length（m）、points、passes、completeness（線のうち計測された割合）、chain（1つの道路端の各部分）、gap（次の部分まで、m）、status（measured 計測済み、doubtful 疑わしい）、reason。</translation>
    </message>
    <message>
        <source>Upper edges</source>
        <translation>上端線</translation>
    </message>
    <message>
        <source>The same along the top: edge_id, kind, height, sigma, sigma_z, status.</source>
        <translation>上端に沿った同様の線: edge_id、kind、height、sigma、sigma_z、status。</translation>
    </message>
    <message>
        <source>All features</source>
        <translation>全地物</translation>
    </message>
    <message>
        <source>GeoPackage (*.gpkg)</source>
        <translation>GeoPackage (*.gpkg)</translation>
    </message>
    <message>
        <source>One GeoPackage with the layers edges, upper_edges and, where given, objects and walls.</source>
        <translation>レイヤedges、upper_edgesと、指定した場合はobjects、wallsを含む1つのGeoPackage。</translation>
    </message>
    <message>
        <source>Edges</source>
        <translation>道路端</translation>
    </message>
    <message>
        <source>Kerbs and lowered kerbs.</source>
        <translation>縁石とその切下げ部です。</translation>
    </message>
    <message>
        <source>Length of kerbs</source>
        <translation>縁石の延長</translation>
    </message>
    <message>
        <source>Without a kerb.</source>
        <translation>縁石のない道路端です。</translation>
    </message>
    <message>
        <source>Length of road borders</source>
        <translation>道路境界の延長</translation>
    </message>
    <message>
        <source>Measured and doubtful ones.</source>
        <translation>計測済みのものと疑わしいものです。</translation>
    </message>
    <message>
        <source>Length of guard rails</source>
        <translation>ガードレールの延長</translation>
    </message>
    <message>
        <source>Walls at the road.</source>
        <translation>道路際の壁面です。</translation>
    </message>
    <message>
        <source>Length of walls</source>
        <translation>壁面の延長</translation>
    </message>
    <message>
        <source>Median standard deviation of measured kerbs across; no value without kerbs.</source>
        <translation>計測された縁石の横断方向の標準偏差の中央値。縁石がない場合は値なし。</translation>
    </message>
    <message>
        <source>Edges or surfaces of roads</source>
        <translation>道路縁または道路面</translation>
    </message>
    <message>
        <source>Polygons of roads, which are dissolved, or lines along both edges of roads, such as the GSI's road edges (RdEdg), in a projected CRS in metres. LOD1 is made of them; for finer levels they tell where sidewalks end.</source>
        <translation>道路のポリゴン（融合する）、または道路の両側の線（国土地理院の道路縁 RdEdg など）。メートル単位の投影座標系。LOD1 はこれから作り、それ以上の詳細度では歩道部の外側の境界となる。</translation>
    </message>
    <message>
        <source>Level of detail</source>
        <translation>詳細度（LOD）</translation>
    </message>
    <message>
        <source>as fine as the inputs allow</source>
        <translation>入力で可能な最も細かいもの</translation>
    </message>
    <message>
        <source>1 of the roads given, 2 and finer of measured edges: 2 without heights; 3.0 with one height across; 3.1 also with lanes and cuts at stop lines; 3.2 with steps from 15 cm; 3.3 with steps from 2 cm; finest: 3.3 where measured edges are given, else 1. (3.3, 1, 2, 3.0, 3.1, 3.2, finest)</source>
        <translation>1 は与えられた道路から、2 以上は測定した縁から作ります。2 は高さなし、3.0 は横断方向に一つの高さ、3.1 は車線と停止線での区切りも、3.2 は 15 cm 以上の段差、3.3 は 2 cm 以上の段差を持ちます。finest は、測定した縁があれば 3.3、なければ 1 です。(3.3, 1, 2, 3.0, 3.1, 3.2, finest)</translation>
    </message>
    <message>
        <source>Measured edges</source>
        <translation>計測した道路縁</translation>
    </message>
    <message>
        <source>Lines of “Road edges”; needed for LOD2 and finer.</source>
        <translation>「道路縁」の線。LOD2 以上に必要。</translation>
    </message>
    <message>
        <source>Upper edges of “Road edges”: heights of steps by place. Without them a kerb has its median height all along.</source>
        <translation>「道路縁」の上端線。場所ごとの段差の高さ。ない場合、縁石の高さは全長で中央値とする。</translation>
    </message>
    <message>
        <source>Lanes</source>
        <translation>車線</translation>
    </message>
    <message>
        <source>Lanes of “Lane map”; where one edge of a road was seen, they tell how far its carriageway goes.</source>
        <translation>「車線地図」の車線。道路の片側の縁だけが見えたところでは、車道の範囲を示します。</translation>
    </message>
    <message>
        <source>Stop lines</source>
        <translation>停止線</translation>
    </message>
    <message>
        <source>Lines of “Lines from road markings”, of which the stop lines are taken, or a layer of stop lines.</source>
        <translation>「路面標示の線」の線（停止線だけを使う）、または停止線のレイヤ。</translation>
    </message>
    <message>
        <source>Heights in metres of what lies more than half a metre from kerbs; without it they come from the edges about.</source>
        <translation>縁石から 0.5 m より離れた場所の標高（m）。ない場合は周囲の道路縁から求める。</translation>
    </message>
    <message>
        <source>Bridges</source>
        <translation>橋梁</translation>
    </message>
    <message>
        <source>Outlines of bridges and viaducts, in the CRS of the roads: surfaces are cut there.</source>
        <translation>橋梁・高架橋の外周。座標参照系は道路と同じものとします。ここで面を区切ります。</translation>
    </message>
    <message>
        <source>Tunnels</source>
        <translation>トンネル</translation>
    </message>
    <message>
        <source>Outlines of tunnels, in the CRS of the roads: surfaces are cut there.</source>
        <translation>トンネルの外周。座標参照系は道路と同じものとします。ここで面を区切ります。</translation>
    </message>
    <message>
        <source>Code of the roads' function</source>
        <translation>道路の機能のコード</translation>
    </message>
    <message>
        <source>Of PLATEAU's list Road_function, for roads that have no field function with one: 1 national expressway, 2 national road, 3 prefectural road, 4 municipal road, 9000 not surveyed, 9020 unknown.</source>
        <translation>PLATEAU のコードリスト Road_function のコードで、フィールド function にコードのない道路に付けます。1 高速自動車国道、2 一般国道、3 都道府県道、4 市町村道、9000 未調査、9020 不明。</translation>
    </message>
    <message>
        <source>Material of the edges</source>
        <translation>道路縁の原典資料</translation>
    </message>
    <message>
        <source>Fundamental Geospatial Data of the GSI</source>
        <translation>基盤地図情報</translation>
    </message>
    <message>
        <source>digital topographic map</source>
        <translation>数値地形図データ</translation>
    </message>
    <message>
        <source>other data</source>
        <translation>その他のデータ</translation>
    </message>
    <message>
        <source>What the edges are from, for the quality attributes of CityGML. (GSI fundamental data, digital topographic map, other data)</source>
        <translation>道路縁の出典。CityGML の品質属性に書きます。（GSI fundamental data、digital topographic map、other data）</translation>
    </message>
    <message>
        <source>Map level of the edges</source>
        <translation>道路縁の地図情報レベル</translation>
    </message>
    <message>
        <source>Of the map that the edges are from, for the quality attributes of CityGML. (none, 500, 1000, 2500, 5000)</source>
        <translation>道路縁の元になった地図の情報レベル。CityGML の品質属性に書きます。（none、500、1000、2500、5000）</translation>
    </message>
    <message>
        <source>Heights of the ground in metres, from which those of the points are counted. Without it the ground is found among the points; where the raster has no value no object is found.</source>
        <translation>点の高さの基準とする地表の標高（m）。ない場合は点群から地表を求めます。ラスタに値がない場所では地物を検出しません。</translation>
    </message>
    <message>
        <source>Objects up to so far from the path, in metres.</source>
        <translation>走行軌跡からこの距離（m）までの地物を検出します。</translation>
    </message>
    <message>
        <source>Lowest object</source>
        <translation>最小の高さ</translation>
    </message>
    <message>
        <source>Lower posts, signs and trees, in metres, are left out; bollards and boxes have heights of their own.</source>
        <translation>これより低い（メートル）柱・標識・樹木は除きます。車止めと箱状の物には独自の高さの範囲があります。</translation>
    </message>
    <message>
        <source>Thickest stem</source>
        <translation>柱・幹の最大直径</translation>
    </message>
    <message>
        <source>What is thicker, in metres, is no post or trunk.</source>
        <translation>これより太いもの（m）は柱や幹とみなしません。</translation>
    </message>
    <message>
        <source>How well the survey is placed as a whole, in metres; it enters the sigma of all objects.</source>
        <translation>計測全体の位置の精度（m）。すべての地物の標準偏差に加わります。</translation>
    </message>
    <message>
        <source>PointZ at the foot: object_id, kind (pole, lamp post, signal, sign, tree, bollard, other upright), confidence (0 to 1), height over the ground, diameter (of the stem, or the longer sides of a box), lean (degrees), azimuth (degrees, of a board's face or an arm), crown (diameter), arm and arm_height (length, and height over the ground), head_height (of what is at its end), board_width, board_height, board_z (height of the board's middle), sigma (east and north each, m), points, passes, status (measured, doubtful), reason, second_kind (the next likely).</source>
        <translation>根元の PointZ：object_id、kind（柱、街灯、信号、標識、樹木、車止め、その他の立体物）、confidence（0～1）、height（地面からの高さ）、diameter（幹・柱の直径、箱では長辺）、lean（度）、azimuth（度、板の面または腕木の向き）、crown（樹冠の直径）、arm と arm_height（長さと地面からの高さ）、head_height（先端の物の高さ）、board_width、board_height、board_z（板の中央の高さ）、sigma（東・北それぞれ、m）、points、passes、status（measured、doubtful）、reason、second_kind（次に確からしい種類）。</translation>
    </message>
    <message>
        <source>Guard rails</source>
        <translation>防護柵</translation>
    </message>
    <message>
        <source>LineStringZ along the foot: rail_id, height, sigma (across), sigma_z, length (m), points, passes, status, reason; as “Road edges” finds them.</source>
        <translation>根元に沿う LineStringZ。rail_id、height（高さ）、sigma（横断方向の標準偏差）、sigma_z（高さの標準偏差）、length（長さ、m）、points（点数）、passes（走行回数）、status（状態）、reason（理由）。「道路端」と同じ方法で求めます。</translation>
    </message>
    <message>
        <source>HTML report: verdict, figures, a map, what is doubtful.</source>
        <translation>HTML レポート。判定、数値、地図、不確かな地物の一覧。</translation>
    </message>
    <message>
        <source>CityGML folder</source>
        <translation>CityGML のフォルダ</translation>
    </message>
    <message>
        <source>CityGML 2.0 with i-UR 3.2 as PLATEAU lays it out: udx/frn (city furniture) and udx/veg (trees) by third meshes, with the lists of codes; LOD1 as blocks, LOD2 of posts with arms and boards.</source>
        <translation>PLATEAU の構成による CityGML 2.0（i-UR 3.2）。udx/frn（都市設備）と udx/veg（樹木）を3次メッシュごとに、コードリストとともに出力します。LOD1 は立体、LOD2 は柱と腕・標識板の面です。</translation>
    </message>
    <message>
        <source>Day on which the model was made, such as 2026-04-01; CityGML has it as creationDate, which PLATEAU asks for.</source>
        <translation>モデルの作成日（例：2026-04-01）。CityGML では PLATEAU が必須とする creationDate になります。</translation>
    </message>
    <message>
        <source>Number of objects.</source>
        <translation>地物の数。</translation>
    </message>
    <message>
        <source>Number of objects that are doubtful.</source>
        <translation>不確かな地物の数。</translation>
    </message>
    <message>
        <source>Doubtful objects</source>
        <translation>不確かな地物</translation>
    </message>
    <message>
        <source>Median standard deviation of the feet of measured objects; no value without any.</source>
        <translation>計測できた地物の根元の標準偏差の中央値。地物がない場合は値なし。</translation>
    </message>
    <message>
        <source>Road surfaces</source>
        <translation>道路面</translation>
    </message>
    <message>
        <source>Polygons: road_id, kind (road, junction, bridge, tunnel), function (code), width (mean, m), arms (roads that meet, of a junction), area (m²), source (official, measured), status (made, to look at), finding.</source>
        <translation>ポリゴン：road_id、kind（道路、交差部、橋梁、トンネル）、function（コード）、width（平均、m）、arms（交差部に集まる道路の数）、area（m²）、source（公的資料・計測）、status（作成・要確認）、finding。</translation>
    </message>
    <message>
        <source>Areas of roads</source>
        <translation>道路の区分面</translation>
    </message>
    <message>
        <source>PolygonZ, of LOD2 and finer: area_id, road_id of its surface, kind (carriageway, junction, lane, sidewalk, island; road, not surveyed), function (code), width (m), area (m²), source (measured, doubtful, continued, official: the weakest of its border), seen (share of the border measured as a kerb without doubt), step (highest, m), sigma (m).</source>
        <translation>LOD2 以上の PolygonZ。area_id、属する道路面の road_id、kind（車道部、交差部、車線、歩道部、島、未計測の道路）、function（コード）、width（m）、area（m²）、source（計測・不確か・延長・公的資料：境界のうち最も弱いもの）、seen（縁石として確かに計測した境界の割合）、step（最大の段差、m）、sigma（m）。</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>手順</translation>
    </message>
    <message>
        <source>LineStringZ along the upper edge of each face: area_id, height, length (m); of LOD3.2 and 3.3.</source>
        <translation>各段差面の上端の LineStringZ。area_id、height、length（m）。LOD3.2 と 3.3。</translation>
    </message>
    <message>
        <source>Middle lines of roads</source>
        <translation>道路中心線</translation>
    </message>
    <message>
        <source>Lines equally far from both edges: road_id of their surface, kind, width and length (m).</source>
        <translation>左右の道路縁から等距離の線：属する面の road_id、kind、width と length（m）。</translation>
    </message>
    <message>
        <source>Findings</source>
        <translation>指摘事項</translation>
    </message>
    <message>
        <source>Points: kind and a sentence on what to look at.</source>
        <translation>点：種類と、確認する内容の文。</translation>
    </message>
    <message>
        <source>CityGML 2.0 with i-UR 3.2 as PLATEAU lays it out: udx/tran by third meshes, with the lists of codes.</source>
        <translation>PLATEAU の構成による CityGML 2.0（i-UR 3.2）：3次メッシュごとの udx/tran とコードリスト。</translation>
    </message>
    <message>
        <source>HTML report: verdict, figures, a map, pictures of the junctions to look at, findings.</source>
        <translation>HTML の報告書：判定、数値、全体図、要確認箇所の図、指摘事項。</translation>
    </message>
    <message>
        <source>Number of surfaces.</source>
        <translation>面の数。</translation>
    </message>
    <message>
        <source>Number of junctions.</source>
        <translation>交差部の数。</translation>
    </message>
    <message>
        <source>Junctions</source>
        <translation>交差部の数</translation>
    </message>
    <message>
        <source>Number of findings.</source>
        <translation>指摘事項の数。</translation>
    </message>
    <message>
        <source>Road model</source>
        <translation>道路モデル</translation>
    </message>
    <message>
        <source>Lines of “Lines from road markings” (fields class, colour, width, sigma, chain, partner; class alone is enough), in a projected CRS in metres; or bounds of an earlier run that were edited by hand, whose ids are kept.</source>
        <translation>「路面標示から線」の線（属性 class、colour、width、sigma、chain、partner。class だけでも可）。メートル単位の投影座標系。または、以前の実行で作り、手作業で編集した境界線（id は保たれます）。</translation>
    </message>
    <message>
        <source>Crosswalks and arrows of “Lines from road markings” (fields class, heading).</source>
        <translation>「路面標示からの線」の横断歩道と矢印（フィールドclass、heading）。</translation>
    </message>
    <message>
        <source>Lines of kerbs, road borders or rails, in the CRS of the lines: they are bounds of lanes too.</source>
        <translation>縁石、道路境界またはガードレールの線。座標参照系は路面標示の線と同じとします。これらも車線の境界となります。</translation>
    </message>
    <message>
        <source>Image of the place with pixels of 0.15 m or finer, in the CRS of the lines: edges of the road that its surface shows become bounds where no kerb was measured, faint lines are looked for where the width of the lanes asks for one, and lines beyond the edge of the road are left out. Findings tell each.</source>
        <translation>区画線と同じ座標参照系の、画素が0.15 m以下のその場所の画像。縁石が計測されていない所では路面の端を車線の境界とし、車線幅から線があるはずの所で薄れた線を探し、道路の端より外の線を除きます。それぞれを指摘で示します。</translation>
    </message>
    <message>
        <source>Corrected trajectories of drives in the CRS of the lines: they show directions and ways through junctions.</source>
        <translation>走行の補正軌跡。座標参照系は路面標示の線と同じとします。通行方向と交差点内の経路を示します。</translation>
    </message>
    <message>
        <source>Road axes</source>
        <translation>道路中心線</translation>
    </message>
    <message>
        <source>Axes of roads of another map, in the CRS of the lines, with any of the fields oneway, lanes and speed_limit or maxspeed as OpenStreetMap has them: they tell directions where nothing else does, and speed limits.</source>
        <translation>別の地図の道路中心線。座標参照系は路面標示の線と同じとし、OpenStreetMapと同様のフィールドoneway、lanes、speed_limitまたはmaxspeedをもつことができます。ほかに情報がない場合の通行方向と、制限速度を与えます。</translation>
    </message>
    <message>
        <source>Points of “Street objects”, in the CRS of the lines: posts, boards and signals go into the Lanelet2 and OpenDRIVE files, signals with the stop line above whose lanes they hang.</source>
        <translation>「道路沿いの地物」の点。線と同じ座標参照系。柱、標識板、信号機を Lanelet2 と OpenDRIVE のファイルに書き、信号機には、その下の車線の停止線を対応させます。</translation>
    </message>
    <message>
        <source>Lines of guard rails of “Street objects”, in the CRS of the lines, for the Lanelet2 and OpenDRIVE files.</source>
        <translation>「道路沿いの地物」の防護柵の線。線と同じ座標参照系。Lanelet2 と OpenDRIVE のファイルに書きます。</translation>
    </message>
    <message>
        <source>Side of the traffic</source>
        <translation>通行側</translation>
    </message>
    <message>
        <source>from the drives</source>
        <translation>走行から判断</translation>
    </message>
    <message>
        <source>traffic on the left</source>
        <translation>左側通行</translation>
    </message>
    <message>
        <source>traffic on the right</source>
        <translation>右側通行</translation>
    </message>
    <message>
        <source>Auto: the side that drives in both directions show, left where they do not. (auto, left, right)</source>
        <translation>auto： 両方向の走行から分かる側。分からない場合は左側。(auto, left, right)</translation>
    </message>
    <message>
        <source>Minimum lane width</source>
        <translation>最小車線幅</translation>
    </message>
    <message>
        <source>Narrower strips are no lanes.</source>
        <translation>これより狭い帯は車線としません。</translation>
    </message>
    <message>
        <source>Maximum lane width</source>
        <translation>最大車線幅</translation>
    </message>
    <message>
        <source>Wider strips are no lanes.</source>
        <translation>これより広い帯は車線としません。</translation>
    </message>
    <message>
        <source>Longest unseen bound</source>
        <translation>見えない境界の最大長</translation>
    </message>
    <message>
        <source>A bound is drawn through gaps of its line up to this length, which are told.</source>
        <translation>線の途切れがこの長さまでの場合、境界をつないで描き、その旨を示します。</translation>
    </message>
    <message>
        <source>Ways that no drive shows</source>
        <translation>走行していない進路</translation>
    </message>
    <message>
        <source>Make virtual lanes through junctions also for the movements that arrows, or else the rule of the road, allow; their evidence says so. Without it only driven ways are made.</source>
        <translation>矢印、または矢印がないときは通行方法の規則で認められる進路についても、交差点内に仮想の車線を作ります。根拠の項目にその旨を示します。指定しないときは、走行した進路だけを作ります。</translation>
    </message>
    <message>
        <source>Confidence of inferred ways</source>
        <translation>推定した通行路の信頼度</translation>
    </message>
    <message>
        <source>Inferred ways that are less sure to be allowed (0 to 1) are not made but told as findings. 0 makes all that the rule of the road allows.</source>
        <translation>許される確からしさ（0～1）がこれより低い推定の通行路は作らず、指摘事項として示します。0 では通行区分の原則が許すものをすべて作ります。</translation>
    </message>
    <message>
        <source>Speed limit</source>
        <translation>制限速度</translation>
    </message>
    <message>
        <source>km/h</source>
        <translation>km/h</translation>
    </message>
    <message>
        <source>Of lanes for which road axes tell none; left empty, they have none.</source>
        <translation>道路中心線に値のない車線の制限速度です。空欄の場合は設定しません。</translation>
    </message>
    <message>
        <source>Dialect of Lanelet2</source>
        <translation>Lanelet2 の方言</translation>
    </message>
    <message>
        <source>elements that every reader takes</source>
        <translation>どのプログラムでも読める要素</translation>
    </message>
    <message>
        <source>with Autoware's extension</source>
        <translation>Autowareの拡張を使う</translation>
    </message>
    <message>
        <source>Of stop lines and crosswalks in the Lanelet2 file. lanelet2: elements that every reader takes (traffic_sign, right_of_way); autoware: road_marking and crosswalk, as Autoware asks, which other programs refuse without Autoware's extension. (lanelet2, autoware)</source>
        <translation>Lanelet2ファイルの停止線と横断歩道の表し方です。lanelet2：どの読み込みプログラムでも扱える要素（traffic_sign、right_of_way）。autoware：Autowareが求めるroad_markingとcrosswalkで、Autowareの拡張がないプログラムでは読み込めません。（lanelet2, autoware）</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>投影法</translation>
    </message>
    <message>
        <source>Of the local coordinates in the Lanelet2 file, for Autoware. (TransverseMercator, MGRS)</source>
        <translation>Lanelet2ファイルのAutoware用ローカル座標の投影法です。(TransverseMercator, MGRS)</translation>
    </message>
    <message>
        <source>Vertical datum</source>
        <translation>高さの基準</translation>
    </message>
    <message>
        <source>not stated</source>
        <translation>記載なし</translation>
    </message>
    <message>
        <source>Of the lines' heights, for Autoware's projector file. (not stated, WGS84, EGM2008)</source>
        <translation>Autowareの投影ファイルに記す、線の高さの基準です。(not stated, WGS84, EGM2008)</translation>
    </message>
    <message>
        <source>Polygons: lane_id, kind (lane, virtual), direction's evidence, width and narrowest (m), turn, arrows, successors, left, right and opposite (ids of neighbours), stop_lines and crosswalks (numbers), yields_to (lane_ids that have the way before it, inferred), yields_by (why), confidence (of ways that no drive shows).</source>
        <translation>ポリゴン：lane_id、kind（lane、virtual）、方向の根拠、幅と最小幅（m）、turn、arrows、successors、left・right・opposite（隣接車線の id）、stop_lines と crosswalks（番号）、yields_to（優先する通行路の lane_id、推定）、yields_by（理由）、confidence（走行軌跡が示さない通行路の信頼度）。</translation>
    </message>
    <message>
        <source>Centre lines of lanes</source>
        <translation>車線の中心線</translation>
    </message>
    <message>
        <source>Lines in the direction of traffic: lane_id, width (m).</source>
        <translation>通行方向の線: lane_id、width（m）。</translation>
    </message>
    <message>
        <source>Bounds of lanes</source>
        <translation>車線の境界</translation>
    </message>
    <message>
        <source>Lines: bound_id, class, colour, width, sigma (m), sigmas (m, at each vertex, growing with the distance to a line), double, unseen (m without a line), lanes (number of lanes that have it).</source>
        <translation>ライン：bound_id、class、colour、width、sigma（m）、sigmas（各頂点の標準偏差 m、線から離れるほど大きい）、double、unseen（線のない長さ m）、lanes（それを持つ車線の数）。</translation>
    </message>
    <message>
        <source>Lanelet2 file</source>
        <translation>Lanelet2ファイル</translation>
    </message>
    <message>
        <source>Lanes, intersections, stop lines and crosswalks with the tags of Lanelet2 and Autoware.</source>
        <translation>車線、交差点、停止線、横断歩道。Lanelet2 と Autoware のタグを付けます。</translation>
    </message>
    <message>
        <source>Projector file</source>
        <translation>投影ファイル</translation>
    </message>
    <message>
        <source>YAML (*.yaml)</source>
        <translation>YAML (*.yaml)</translation>
    </message>
    <message>
        <source>Autoware's map_projector_info.yaml of the Lanelet2 file.</source>
        <translation>Lanelet2ファイルに対応するAutowareのmap_projector_info.yaml。</translation>
    </message>
    <message>
        <source>OpenDRIVE file</source>
        <translation>OpenDRIVEファイル</translation>
    </message>
    <message>
        <source>OpenDRIVE (*.xodr)</source>
        <translation>OpenDRIVE (*.xodr)</translation>
    </message>
    <message>
        <source>Roads, junctions, road marks, stop lines and crosswalks as ASAM OpenDRIVE 1.7; coordinates are those of the CRS less the header's offset.</source>
        <translation>ASAM OpenDRIVE 1.7形式の道路、交差点、路面標示、停止線、横断歩道。座標は座標参照系の値からヘッダのオフセットを引いたものです。</translation>
    </message>
    <message>
        <source>Points: kind and a sentence on what is missing or contradicts.</source>
        <translation>点: 種類と、不足または矛盾を説明する文。</translation>
    </message>
    <message>
        <source>HTML report: verdict, figures, pictures of the junctions and findings with their places.</source>
        <translation>HTML報告書: 判定、数値、交差点の図、位置付きの指摘事項。</translation>
    </message>
    <message>
        <source>Number of lanes, virtual ones included.</source>
        <translation>車線の数です（仮想車線を含む）。</translation>
    </message>
    <message>
        <source>Of their centre lines, virtual ones not counted.</source>
        <translation>車線の中心線の値です（仮想車線を除く）。</translation>
    </message>
    <message>
        <source>Length of lanes</source>
        <translation>車線の延長</translation>
    </message>
    <message>
        <source>Lane map</source>
        <translation>車線地図</translation>
    </message>
    <message>
        <source>Check points</source>
        <translation>検証点</translation>
    </message>
    <message>
        <source>Table or layer with x, y, z (true, metres) and x_product, y_product, z_product; id, and role (check or adjusted), where there are such columns; or the residuals of an earlier run; or the table of edges with x, y, z filled in; or control points, with a trajectory. Without check points nothing is judged.</source>
        <translation>x、y、z（真値、m）とx_product、y_product、z_product（成果の座標）の列をもつ表かレイヤです。あればid列と、role列（checkまたはadjusted）も使います。以前の実行の残差、x、y、zを記入した辺の表、軌跡を指定した場合は検証点の表も使えます。検証点がなければ判定しません。</translation>
    </message>
    <message>
        <source>The trajectory with which a mobile survey was placed: CSV time,x,y,z,roll,pitch,heading, SBET, or a point layer with these fields. The check points are then control points: id,x,y,z (where a point truly lies, metres) and time,x_mms,y_mms,z_mms (when the survey measured it, GPS seconds, and where it lies in the survey); heights may be missing.</source>
        <translation>MMS計測データの座標付けに使った軌跡です。CSV time,x,y,z,roll,pitch,heading、SBET、またはこれらのフィールドを持つ点レイヤを指定します。このとき検証点は、id,x,y,z（点の正しい位置、m）とtime,x_mms,y_mms,z_mms（計測時刻（GPS秒）と計測データ上の位置）の列を持つものとします。高さはなくてもかまいません。</translation>
    </message>
    <message>
        <source>The same after a correction. Without it the survey is measured as it is.</source>
        <translation>補正後の同じ軌跡です。指定しない場合は、計測データをそのまま評価します。</translation>
    </message>
    <message>
        <source>MultiPolygonZ with all faces of each building: edges to be surveyed are drawn from them.</source>
        <translation>建物ごとにすべての面をもつMultiPolygonZです。点検測量する辺をここから抽出します。</translation>
    </message>
    <message>
        <source>Laser points of the edges</source>
        <translation>辺を確かめるレーザ点群</translation>
    </message>
    <message>
        <source>LAS, LAZ or COPC files in the CRS of the models, in which edges of the building models are looked for; not together with check points.</source>
        <translation>モデルと同じ座標参照系の LAS、LAZ、COPC ファイル。建物モデルの辺をこの中で探します。検証点と同時には使えません。</translation>
    </message>
    <message>
        <source>Edges shown by</source>
        <translation>辺の現れ方</translation>
    </message>
    <message>
        <source>roof edges</source>
        <translation>屋根の縁</translation>
    </message>
    <message>
        <source>roof edges: where the roof's points end, of airborne points, with heights; walls: faces of walls, of points from the street, without heights. (roof edges, walls)</source>
        <translation>roof edges：屋根の縁：屋根の点が終わる位置（航空レーザ、標高あり）。walls：壁面の位置（道路からの点群、標高なし）。（roof edges, walls）</translation>
    </message>
    <message>
        <source>Points of another, more accurate survey</source>
        <translation>別の、より精度の高い測量の点群</translation>
    </message>
    <message>
        <source>The laser points are of another survey than the models and more accurate: only then are the models judged.</source>
        <translation>レーザ点群がモデルの作成に使ったものとは別の測量で、より精度が高い場合に選びます。そのときだけモデルを判定します。</translation>
    </message>
    <message>
        <source>Product</source>
        <translation>成果の種類</translation>
    </message>
    <message>
        <source>mobile survey</source>
        <translation>MMS計測</translation>
    </message>
    <message>
        <source>building models</source>
        <translation>建物モデル</translation>
    </message>
    <message>
        <source>Building models are judged as PLATEAU's tables P05 to P08 ask: 42 check points (21 edges with two each) in each unit. (survey, buildings)</source>
        <translation>建物モデル（buildings）は、PLATEAU標準製品仕様書の表P05～P08に従い、検査単位ごとに検証点42点（21辺、各2点）で判定します。（survey, buildings）</translation>
    </message>
    <message>
        <source>Map level</source>
        <translation>地図情報レベル</translation>
    </message>
    <message>
        <source>limits given below</source>
        <translation>下に指定する制限値</translation>
    </message>
    <message>
        <source>Whose limits hold: the standard deviation may be 0.12, 0.25, 0.70, 1.75, 3.50 m in plan and 0.25, 0.25, 0.33, 0.66, 1.66 m in height; given: the limits below. (250, 500, 1000, 2500, 5000, given)</source>
        <translation>制限値を定める地図情報レベルです。標準偏差の制限値は、水平位置が0.12、0.25、0.70、1.75、3.50 m、標高が0.25、0.25、0.33、0.66、1.66 mです。givenの場合は下の制限値を使います。（250, 500, 1000, 2500, 5000, given）</translation>
    </message>
    <message>
        <source>Limit in plan</source>
        <translation>水平位置の制限値</translation>
    </message>
    <message>
        <source>Greatest standard deviation in plan; it takes the place of the map level's.</source>
        <translation>水平位置の標準偏差の制限値です。地図情報レベルの値に代わります。</translation>
    </message>
    <message>
        <source>Limit in height</source>
        <translation>標高の制限値</translation>
    </message>
    <message>
        <source>Greatest standard deviation in height; it takes the place of the map level's.</source>
        <translation>標高の標準偏差の制限値です。地図情報レベルの値に代わります。</translation>
    </message>
    <message>
        <source>Minimum number of points</source>
        <translation>最少点数</translation>
    </message>
    <message>
        <source>With fewer check points in a unit nothing is judged. If none is given: 42 for buildings, 1 for a survey.</source>
        <translation>検査単位の検証点がこれより少ない場合は判定しません。指定しない場合は、建物では42点、計測では1点です。</translation>
    </message>
    <message>
        <source>Unit of inspection</source>
        <translation>検査単位</translation>
    </message>
    <message>
        <source>Field that names the unit of each point, such as a mesh or a drive: each unit is judged by itself. If none is chosen, all points are one.</source>
        <translation>各点の検査単位（メッシュや走行など）の名前を示すフィールドです。検査単位ごとに判定します。指定しない場合は全点を一つの検査単位とします。</translation>
    </message>
    <message>
        <source>Patches of the registration</source>
        <translation>位置合わせのパッチ</translation>
    </message>
    <message>
        <source>From “Register mobile survey”: mean, standard deviation and maximum of its figures are told.</source>
        <translation>「MMS計測の位置合わせ」のパッチです。平均、標準偏差、最大値を記載します。</translation>
    </message>
    <message>
        <source>Job</source>
        <translation>作業名</translation>
    </message>
    <message>
        <source>For the head of the report; what is left out stays blank, to be filled in by hand.</source>
        <translation>報告書の見出し欄に記載します。指定しない項目は、手で記入できるよう空欄とします。</translation>
    </message>
    <message>
        <source>Area of the work</source>
        <translation>地区名</translation>
    </message>
    <message>
        <source>Client</source>
        <translation>計画機関</translation>
    </message>
    <message>
        <source>Surveyor</source>
        <translation>作業機関</translation>
    </message>
    <message>
        <source>Dates of the work</source>
        <translation>作業期間</translation>
    </message>
    <message>
        <source>Chief engineer</source>
        <translation>主任技術者</translation>
    </message>
    <message>
        <source>Survey party leader</source>
        <translation>作業班長</translation>
    </message>
    <message>
        <source>Quantity of work</source>
        <translation>作業量</translation>
    </message>
    <message>
        <source>Instrument</source>
        <translation>主要機器（名称・番号）</translation>
    </message>
    <message>
        <source>Checked by</source>
        <translation>点検者</translation>
    </message>
    <message>
        <source>Remarks</source>
        <translation>特記事項</translation>
    </message>
    <message>
        <source>HTML report, which prints on A4.</source>
        <translation>A4で印刷できるHTML報告書です。</translation>
    </message>
    <message>
        <source>Report as PDF</source>
        <translation>報告書（PDF）</translation>
    </message>
    <message>
        <source>PDF (*.pdf)</source>
        <translation>PDF (*.pdf)</translation>
    </message>
    <message>
        <source>The same as PDF pages of A4, made by QGIS's printing.</source>
        <translation>同じ内容を、QGISの印刷機能でA4のPDFにします。</translation>
    </message>
    <message>
        <source>Edges to be surveyed</source>
        <translation>点検測量する辺</translation>
    </message>
    <message>
        <source>CSV (*.csv)</source>
        <translation>CSV (*.csv)</translation>
    </message>
    <message>
        <source>Both ends of the drawn edges with their place in the models; x, y and z are left blank for the survey.</source>
        <translation>抽出した辺の両端と、モデル上の座標です。x、y、zは点検測量の結果を記入する欄として空けてあります。</translation>
    </message>
    <message>
        <source>All points</source>
        <translation>全点</translation>
    </message>
    <message>
        <source>Every check point, or every drawn edge, with its errors.</source>
        <translation>すべての検証点、または抽出したすべての辺とその較差。</translation>
    </message>
    <message>
        <source>Layout templates (*.qpt)</source>
        <translation>レイアウトテンプレート (*.qpt)</translation>
    </message>
    <message>
        <source>Layout of the PDF</source>
        <translation>PDFのレイアウト</translation>
    </message>
    <message>
        <source>Layout template of QGIS (.qpt): a changed copy of the plugin's resources/layouts/acceptance.qpt, whose items are filled by their ids.</source>
        <translation>QGISの印刷レイアウトのテンプレート（.qpt）です。プラグインの resources/layouts/acceptance.qpt の複製を変更して使います。アイテムはIDによって埋められます。</translation>
    </message>
    <message>
        <source>One point at each control point, with the error before and after (m, east, north, up, in plan and in space).</source>
        <translation>検証点ごとに1点です。補正前後の誤差（m、東・北・上、水平、3次元）を持ちます。</translation>
    </message>
    <message>
        <source>Report of the residuals</source>
        <translation>残差の報告書</translation>
    </message>
    <message>
        <source>Figures, errors over time, the worst points.</source>
        <translation>数値、誤差の時間変化、誤差の大きい点を示します。</translation>
    </message>
    <message>
        <source>Mean error in plan at the control points.</source>
        <translation>検証点での水平誤差の平均です。</translation>
    </message>
    <message>
        <source>Mean error in plan</source>
        <translation>水平誤差の平均</translation>
    </message>
    <message>
        <source>Maximum error in plan at the control points.</source>
        <translation>検証点での水平誤差の最大値です。</translation>
    </message>
    <message>
        <source>Maximum error in plan</source>
        <translation>水平誤差の最大値</translation>
    </message>
    <message>
        <source>Standard deviation of errors in plan at the control points.</source>
        <translation>検証点での水平誤差の標準偏差です。</translation>
    </message>
    <message>
        <source>Standard deviation of errors in plan</source>
        <translation>水平誤差の標準偏差</translation>
    </message>
    <message>
        <source>Mean error in space at the control points.</source>
        <translation>検証点での3次元誤差の平均です。</translation>
    </message>
    <message>
        <source>Mean error in space</source>
        <translation>3次元誤差の平均</translation>
    </message>
    <message>
        <source>Maximum error in space at the control points.</source>
        <translation>検証点での3次元誤差の最大値です。</translation>
    </message>
    <message>
        <source>Maximum error in space</source>
        <translation>3次元誤差の最大値</translation>
    </message>
    <message>
        <source>Standard deviation of errors in space at the control points.</source>
        <translation>検証点での3次元誤差の標準偏差です。</translation>
    </message>
    <message>
        <source>Standard deviation of errors in space</source>
        <translation>3次元誤差の標準偏差</translation>
    </message>
    <message>
        <source>Standard deviation in plan about 0</source>
        <translation>水平位置の標準偏差（母平均0）</translation>
    </message>
    <message>
        <source>Standard deviation in height about 0</source>
        <translation>標高の標準偏差（母平均0）</translation>
    </message>
    <message>
        <source>Maximum error in height</source>
        <translation>標高の較差の最大値</translation>
    </message>
    <message>
        <source>passed, failed, or not checked.</source>
        <translation>passed（合格）、failed（不合格）、not checked（未判定）のいずれかです。</translation>
    </message>
    <message>
        <source>Outcome</source>
        <translation>判定</translation>
    </message>
    <message>
        <source>Acceptance report</source>
        <translation>精度管理表</translation>
    </message>
    <message>
        <source>City models and lane maps (*.gml *.GML *.zip *.osm);;All files (*)</source>
        <translation>3D都市モデルと車線地図 (*.gml *.GML *.zip *.osm);;すべてのファイル (*)</translation>
    </message>
    <message>
        <source>City model or lane map</source>
        <translation>3D都市モデルまたは車線地図</translation>
    </message>
    <message>
        <source>CityGML (.gml), a .zip of a data set, or a Lanelet2 file (.osm). The path of a folder can be typed here as well.</source>
        <translation>CityGML（.gml）、データセットの.zip、またはLanelet2ファイル（.osm）。フォルダのパスを入力することもできます。</translation>
    </message>
    <message>
        <source>All CityGML files in this folder and its subfolders; instead of the file or beside it.</source>
        <translation>このフォルダとサブフォルダにあるすべての CityGML ファイル。ファイルの代わりに、又はファイルと合わせて指定します。</translation>
    </message>
    <message>
        <source>Rules left out</source>
        <translation>除外する規則</translation>
    </message>
    <message>
        <source>Codes of rules that are not looked at, with commas between them; the begin of a code stands for all that begin so, such as L-bldg or Lane.BorderSharing.</source>
        <translation>検査しない規則のコード（カンマ区切り）。コードの先頭だけを書くと、それで始まるすべての規則を表します（例：L-bldg、Lane.BorderSharing）。</translation>
    </message>
    <message>
        <source>Points (longitude, latitude): rule (its code), severity (error, warning, info), text, source of the rule; of a city model also requirement (code of the specification), file, type and gml_id of the feature, lod (-1 without); of a map also element. Faults without a place have no geometry.</source>
        <translation>点（経度・緯度）：rule（規則のコード）、severity（error、warning、info）、text（内容）、source（規則の出典）。3D都市モデルではrequirement（仕様書の番号）、file（ファイル）、地物のtype（型）とgml_id、lod（ない場合は-1）、地図ではelement（要素）も。位置のない不備にはジオメトリがありません。</translation>
    </message>
    <message>
        <source>Table of results</source>
        <translation>検査結果一覧</translation>
    </message>
    <message>
        <source>CSV, a line a file: its size and the number of faults of each rule; of city models only.</source>
        <translation>CSV。1行1ファイルで、サイズと規則ごとの不適合の数。3D都市モデルのみ。</translation>
    </message>
    <message>
        <source>Table of instances</source>
        <translation>地物インスタンス数</translation>
    </message>
    <message>
        <source>CSV, a line a file: the number of features of each type, to be compared with the reference data (C02); of city models only.</source>
        <translation>CSV。1行1ファイルで、地物型ごとの数。参照データとの比較（C02）に使います。3D都市モデルのみ。</translation>
    </message>
    <message>
        <source>HTML report: numbers by rule or requirement, verdicts, the faults, what is not checked.</source>
        <translation>HTMLの報告書：規則または品質要求ごとの件数、判定、不備の一覧、検査していない項目。</translation>
    </message>
    <message>
        <source>Number of city objects in the files.</source>
        <translation>ファイルに含まれる地物（都市オブジェクト）の数。</translation>
    </message>
    <message>
        <source>City objects</source>
        <translation>地物</translation>
    </message>
    <message>
        <source>Number of lanelets in the file.</source>
        <translation>ファイル内のlaneletの数です。</translation>
    </message>
    <message>
        <source>Lanelets</source>
        <translation>lanelet</translation>
    </message>
    <message>
        <source>Number of errors.</source>
        <translation>エラーの件数です。</translation>
    </message>
    <message>
        <source>Errors</source>
        <translation>エラー</translation>
    </message>
    <message>
        <source>Number of warnings.</source>
        <translation>警告の件数です。</translation>
    </message>
    <message>
        <source>Warnings</source>
        <translation>警告</translation>
    </message>
    <message>
        <source>Check city model or lane map</source>
        <translation>3D都市モデル・車線地図の検査</translation>
    </message>
    <message>
        <source>Vote and darkest: our way, with that vehicle filter. Paper: as in the paper, frames masked by their occlusion maps, the darkest of them, and the plain adaptive threshold (in the model set the method of the markings too). (vote, darkest, paper)</source>
        <translation>voteとdarkest: 本プラグインの方法で、指定した車両除去を行います。paper: 論文のとおり、写真を遮蔽図でマスクし、最も暗い画素を採用して、単純な適応的閾値処理を行います（モデルでは路面標示の方法も設定してください）。(vote, darkest, paper)</translation>
    </message>
    <message>
        <source>Method of the markings</source>
        <translation>路面標示の方法</translation>
    </message>
    <message>
        <source>Resolution of the surface</source>
        <translation>表層の解像度</translation>
    </message>
    <message>
        <source>Road markings from aerial frames</source>
        <translation>空中写真からの路面標示</translation>
    </message>
    <message>
        <source>partition: outlines divided among their roofs; points: outlines drawn from the points, then divided; paper: the paper's method in every step.</source>
        <translation>partition: 外周線を屋根ごとに分割します。points: 点群から外形を描いて分割します。paper: すべての段階を論文の方法で行います。</translation>
    </message>
    <message>
        <source>Buildings from ALS</source>
        <translation>航空レーザ点群からの建物</translation>
    </message>
    <message>
        <source>Georeferenced survey</source>
        <translation>位置合わせ後のMMS計測</translation>
    </message>
    <message>
        <source>Georeference mobile survey</source>
        <translation>MMS計測の位置合わせ</translation>
    </message>
    <message>
        <source>Lane map from markings and drives</source>
        <translation>路面標示と走行からの車線地図</translation>
    </message>
    <message>
        <source>CityGML folder of furniture and trees</source>
        <translation>都市設備・樹木の CityGML フォルダ</translation>
    </message>
    <message>
        <source>Report on the objects</source>
        <translation>地物の報告書</translation>
    </message>
    <message>
        <source>Road space from a mobile survey</source>
        <translation>MMS から道路空間</translation>
    </message>
    <message>
        <source>UrbanMap job (*.urbanmap.json *.json)</source>
        <translation>UrbanMapの作業 (*.urbanmap.json *.json)</translation>
    </message>
    <message>
        <source>File of the job (.urbanmap.json).</source>
        <translation>作業のファイル（.urbanmap.json）。</translation>
    </message>
    <message>
        <source>Other inputs</source>
        <translation>別の入力</translation>
    </message>
    <message>
        <source>Lines ROLE=FILE that take the place of the job's own inputs, with the roles of the job, such as survey_1=drive.laz. Relative paths count from the job's folder.</source>
        <translation>作業の入力に代わる「役割=ファイル」の行。役割は作業のもの（例：survey_1=drive.laz）。相対パスは作業のフォルダから数えます。</translation>
    </message>
    <message>
        <source>Ids of the steps to run, with commas between them; all if none is given.</source>
        <translation>実行する手順のid（コンマ区切り）。指定しなければすべて。</translation>
    </message>
    <message>
        <source>Run all steps again</source>
        <translation>すべての手順を再実行</translation>
    </message>
    <message>
        <source>Also those that are done.</source>
        <translation>完了しているものも実行します。</translation>
    </message>
    <message>
        <source>Folder of the results</source>
        <translation>結果のフォルダ</translation>
    </message>
    <message>
        <source>If none is given, a folder beside the job, under its name.</source>
        <translation>指定しなければ、作業ファイルと同じ場所の、作業名のフォルダ。</translation>
    </message>
    <message>
        <source>Each step with its state, verdict and results.</source>
        <translation>各手順の状態、判定、結果。</translation>
    </message>
    <message>
        <source>File in which it stands how far the job is.</source>
        <translation>作業の進み具合を記録したファイル。</translation>
    </message>
    <message>
        <source>Job file</source>
        <translation>作業ファイル</translation>
    </message>
    <message>
        <source>Folder in which the results lie.</source>
        <translation>結果のあるフォルダ。</translation>
    </message>
    <message>
        <source>Results</source>
        <translation>結果</translation>
    </message>
    <message>
        <source>Steps that were run now.</source>
        <translation>今回実行した手順の数。</translation>
    </message>
    <message>
        <source>Steps run</source>
        <translation>実行した手順</translation>
    </message>
    <message>
        <source>Steps that were done before and left alone.</source>
        <translation>すでに完了していて、そのまま残した手順の数。</translation>
    </message>
    <message>
        <source>Steps kept</source>
        <translation>そのまま残した手順</translation>
    </message>
    <message>
        <source>Run a job</source>
        <translation>作業の実行</translation>
    </message>
    <message>
        <source>Algorithm</source>
        <translation>アルゴリズム</translation>
    </message>
    <message>
        <source>Surface and ground from ALS</source>
        <translation>航空レーザからの表層と地表</translation>
    </message>
    <message>
        <source>Ground of a mobile survey</source>
        <translation>MMS計測の地表面</translation>
    </message>
    <message>
        <source>2.5D mesh of buildings</source>
        <translation>建物の2.5Dメッシュ</translation>
    </message>
    <message>
        <source>Walls from a mobile survey</source>
        <translation>MMS計測の壁面</translation>
    </message>
    <message>
        <source>Orthorectify frames</source>
        <translation>写真のオルソ補正</translation>
    </message>
    <message>
        <source>What is run on each tile. (buildingsfromals, surfacefromals, roadmarkingsfromorthophoto, groundfrommms, mesh25d, wallsfrommms, orthorectifyframes, aerialmarkings, roadmarkingsfrommms, mergebuildingmodels)</source>
        <translation>各タイルで実行する処理です。(buildingsfromals, surfacefromals, roadmarkingsfromorthophoto, groundfrommms, mesh25d, wallsfrommms, orthorectifyframes, aerialmarkings, roadmarkingsfrommms, mergebuildingmodels)</translation>
    </message>
    <message>
        <source>LAS, LAZ or COPC files of the whole area, in any pieces.</source>
        <translation>全域のLAS、LAZまたはCOPCファイル（分割は任意）。</translation>
    </message>
    <message>
        <source>Outlines of the whole area.</source>
        <translation>全域の外周線。</translation>
    </message>
    <message>
        <source>For road markings: the orthophoto of the whole area.</source>
        <translation>路面標示の場合: 全域のオルソ画像。</translation>
    </message>
    <message>
        <source>Settings of the algorithm</source>
        <translation>アルゴリズムの設定</translation>
    </message>
    <message>
        <source>Lines NAME=VALUE, with the algorithm's own names, such as GROUND=ground.tif or MIN_ROOF_AREA=20. An output is made where it is by default, or where a line such as OUTPUT_GROUND=yes asks for it.</source>
        <translation>NAME=VALUEの形式の行で、アルゴリズム自身のパラメータ名を用います（例: GROUND=ground.tif、MIN_ROOF_AREA=20）。出力は、既定で作成されるものと、OUTPUT_GROUND=yesのような行で求めたものを作成します。</translation>
    </message>
    <message>
        <source>Tile</source>
        <translation>タイル</translation>
    </message>
    <message>
        <source>Side of a tile, whole metres; corners lie on its multiples.</source>
        <translation>タイルの一辺（メートルの整数）です。四隅はその倍数の位置となります。</translation>
    </message>
    <message>
        <source>squares of the tile size</source>
        <translation>タイルの大きさの正方形</translation>
    </message>
    <message>
        <source>standard regional mesh, 1 km</source>
        <translation>基準地域メッシュ（約1 km）</translation>
    </message>
    <message>
        <source>standard regional mesh, 500 m</source>
        <translation>2分の1地域メッシュ（約500 m）</translation>
    </message>
    <message>
        <source>standard regional mesh, 250 m</source>
        <translation>4分の1地域メッシュ（約250 m）</translation>
    </message>
    <message>
        <source>map sheet of level 5000</source>
        <translation>国土基本図図郭（地図情報レベル5000）</translation>
    </message>
    <message>
        <source>map sheet of level 2500</source>
        <translation>国土基本図図郭（地図情報レベル2500）</translation>
    </message>
    <message>
        <source>map sheet of level 1000</source>
        <translation>国土基本図図郭（地図情報レベル1000）</translation>
    </message>
    <message>
        <source>map sheet of level 500</source>
        <translation>国土基本図図郭（地図情報レベル500）</translation>
    </message>
    <message>
        <source>Squares of the side above; or Japan's standard regional meshes (JIS X 0410) of about 1 km, 500 m or 250 m; or the sheets of public survey maps of level 5000 (4 by 3 km), 2500 (2 by 1.5 km), 1000 (800 by 600 m) or 500 (400 by 300 m), in a plane rectangular system. Tiles are then named by their codes. (squares, mesh1km, mesh500m, mesh250m, sheet5000, sheet2500, sheet1000, sheet500)</source>
        <translation>上記の辺長の正方形。または標準地域メッシュ（JIS X 0410）の約1 km、500 m、250 m。または平面直角座標系による公共測量の国土基本図図郭の地図情報レベル5000（4×3 km）、2500（2×1.5 km）、1000（800×600 m）、500（400×300 m）。この場合、タイル名はそのコードとなります。(squares, mesh1km, mesh500m, mesh250m, sheet5000, sheet2500, sheet1000, sheet500)</translation>
    </message>
    <message>
        <source>Buffer</source>
        <translation>バッファ</translation>
    </message>
    <message>
        <source>Width of the surroundings that a tile reads: more than the largest building, and than the reach of ground under buildings.</source>
        <translation>タイルの周囲で読み込む幅です。最大の建物や、建物の下の地表を求めるのに必要な範囲より大きくします。</translation>
    </message>
    <message>
        <source>Tiles to try</source>
        <translation>試行タイル数</translation>
    </message>
    <message>
        <source>Only this many tiles, spread over the area, to say what all will take in time, memory and disk; 0 does all.</source>
        <translation>領域に分散したこの数のタイルだけを処理し、全体に要する時間、メモリ、ディスクを見積もります。0ではすべて処理します。</translation>
    </message>
    <message>
        <source>Tiles</source>
        <translation>タイル</translation>
    </message>
    <message>
        <source>One square a tile with status, reason, time, memory.</source>
        <translation>タイルごとに1つの正方形: status、reason、time、memory。</translation>
    </message>
    <message>
        <source>Folder of the run</source>
        <translation>実行フォルダ</translation>
    </message>
    <message>
        <source>Results by tile, merged results, and what a later run needs to go on.</source>
        <translation>タイル別の結果、統合した結果、および後で処理を続けるために必要なもの。</translation>
    </message>
    <message>
        <source>HTML report: how many buildings or walls are ok, doubtful and failed, which tiles failed and why, time, memory, disk, a map.</source>
        <translation>HTML 報告書：良好・要確認・失敗の建物または壁の数、失敗したタイルとその理由、時間、メモリ、ディスク、地図。</translation>
    </message>
    <message>
        <source>Number of them.</source>
        <translation>タイルの数です。</translation>
    </message>
    <message>
        <source>Tiles done</source>
        <translation>処理済みタイル</translation>
    </message>
    <message>
        <source>Empty tiles</source>
        <translation>空のタイル</translation>
    </message>
    <message>
        <source>Failed tiles</source>
        <translation>失敗したタイル</translation>
    </message>
    <message>
        <source>Tiles kept from an earlier run</source>
        <translation>前回の結果を用いたタイル</translation>
    </message>
    <message>
        <source>Run over tiles</source>
        <translation>タイル処理</translation>
    </message>
    <message>
        <source>2. Lays the frames on the ground that they see, without moving vehicles.</source>
        <translation>2. 写真を、写っている地表に正射投影します。走行車両は除きます。</translation>
    </message>
    <message>
        <source>3. Finds the road markings, with their heights, and reports on them.</source>
        <translation>3. 路面標示を標高とともに検出し、報告書を作成します。</translation>
    </message>
    <message>
        <source>1. Makes the surface, which tells what hides the ground, and the bare ground.</source>
        <translation>1. 地表を隠すものを示す表層と、地盤面を作成します。</translation>
    </message>
    <message>
        <source>Goes from aerial frames and airborne laser points to the reference that mobile surveys are tied to, in one run: surface and ground from ALS, orthophoto of the ground that the frames see, without moving vehicles, and road markings with their heights.&lt;/p&gt;&lt;p&gt;This is the same chain as “Road markings from aerial frames”, as a model: the menu Plugins &gt; UrbanMap &gt; Open a chain in the modeller opens a copy to look at and to change.</source>
        <translation>空中写真と航空レーザ点群から、MMS計測の位置の基準となる成果までを一度に作成します: 航空レーザからの表層と地表、写真に写る地表のオルソ画像（移動車両なし）、高さ付きの路面標示。&lt;/p&gt;&lt;p&gt;「空中写真からの路面標示」と同じ一連の処理をモデルとしたものです。メニュー「プラグイン &gt; UrbanMap &gt; 処理の流れをモデルデザイナーで開く」で複製を開き、各段階を確認し変更できます。</translation>
    </message>
    <message>
        <source>Workflows</source>
        <translation>一連の処理</translation>
    </message>
    <message>
        <source>Road markings from aerial frames (model)</source>
        <translation>空中写真からの路面標示（モデル）</translation>
    </message>
    <message>
        <source>4. Joins the roofs to closed solids on the ground, checks and measures each.</source>
        <translation>4. 屋根を地盤面までの閉じた立体にし、それぞれを検査し計測します。</translation>
    </message>
    <message>
        <source>3. Draws the polygon of each roof from its points.</source>
        <translation>3. 屋根ごとに、点群からポリゴンを作成します。</translation>
    </message>
    <message>
        <source>1. Moves each outline to its building and takes the points out of the cloud.</source>
        <translation>1. 各外周線を建物の位置へ移動し、点群から建物の点を取り出します。</translation>
    </message>
    <message>
        <source>2. Segments the roofs of each building: its planes, or level roofs.</source>
        <translation>2. 建物ごとに屋根を平面または水平な屋根に分割します。</translation>
    </message>
    <message>
        <source>Goes from airborne laser points and rough outlines to closed 3D building models in one run: segment buildings, segment roofs, roof polygons, building models.&lt;/p&gt;&lt;p&gt;This is the same chain as “Buildings from ALS”, as a model: the menu Plugins &gt; UrbanMap &gt; Open a chain in the modeller opens a copy to look at and to change.</source>
        <translation>航空レーザ点群と概略の外周線から、閉じた3次元建物モデルまでを一度に作成します: 建物の抽出、屋根の分割、屋根ポリゴン、建物モデル。&lt;/p&gt;&lt;p&gt;「航空レーザ点群からの建物」と同じ一連の処理をモデルとしたものです。メニュー「プラグイン &gt; UrbanMap &gt; 処理の流れをモデルデザイナーで開く」で複製を開き、各段階を確認し変更できます。</translation>
    </message>
    <message>
        <source>Buildings from ALS (model)</source>
        <translation>航空レーザ点群からの建物（モデル）</translation>
    </message>
    <message>
        <source>3. Moves the survey's points and images with the corrected trajectory.</source>
        <translation>3. 補正した走行軌跡により、計測の点群と画像を移動します。</translation>
    </message>
    <message>
        <source>2. Lays them on the reference markings: the corrected trajectory, and how sure it is.</source>
        <translation>2. 基準の路面標示に位置合わせし、補正した走行軌跡とその精度を求めます。</translation>
    </message>
    <message>
        <source>1. Takes the points on road markings out of the survey by their intensity.</source>
        <translation>1. 反射強度により、計測から路面標示上の点を取り出します。</translation>
    </message>
    <message>
        <source>Goes from a mobile survey to the same survey lying on the aerial reference, in one run: its road markings by intensity, their registration to the reference markings, and the points as the corrected trajectory places them.&lt;/p&gt;&lt;p&gt;This is the same chain as “Georeference mobile survey”, as a model: the menu Plugins &gt; UrbanMap &gt; Open a chain in the modeller opens a copy to look at and to change.</source>
        <translation>MMS計測を空中写真の基準に合わせるまでを一度に行います: 反射強度による路面標示の抽出、基準の路面標示への位置合わせ、補正軌跡による点群の再配置。&lt;/p&gt;&lt;p&gt;「MMS計測の位置合わせ」と同じ一連の処理をモデルとしたものです。メニュー「プラグイン &gt; UrbanMap &gt; 処理の流れをモデルデザイナーで開く」で複製を開き、各段階を確認し変更できます。</translation>
    </message>
    <message>
        <source>Georeference mobile survey (model)</source>
        <translation>MMS計測の位置合わせ（モデル）</translation>
    </message>
    <message>
        <source>1. Makes line work of the markings: lines, stop lines, crosswalks and arrows.</source>
        <translation>1. 標示から区画線、停止線、横断歩道、矢印の線を作成します。</translation>
    </message>
    <message>
        <source>2. Makes lanes of the lines and the drives, and tells what is missing.</source>
        <translation>2. 線と走行から車線を作成し、不足を示します。</translation>
    </message>
    <message>
        <source>Goes from reference markings and corrected drives to a lane map, in one run: line work of the markings, then lanes with their bounds, directions and connections, as layers, as Lanelet2 file for Autoware and as OpenDRIVE file.&lt;/p&gt;&lt;p&gt;This is the same chain as “Lane map from markings and drives”, as a model: the menu Plugins &gt; UrbanMap &gt; Open a chain in the modeller opens a copy to look at and to change.</source>
        <translation>基準の路面標示と補正済みの走行から、車線地図までを一度に作成します: 路面標示の線、次に境界、方向、接続をもつ車線を、レイヤ、Autoware用のLanelet2ファイル、OpenDRIVEファイルとして出力します。&lt;/p&gt;&lt;p&gt;「路面標示と走行からの車線地図」と同じ一連の処理をモデルとしたものです。メニュー「プラグイン &gt; UrbanMap &gt; 処理の流れをモデルデザイナーで開く」で複製を開き、各段階を確認し変更できます。</translation>
    </message>
    <message>
        <source>Lane map from markings and drives (model)</source>
        <translation>路面標示と走行からの車線地図（モデル）</translation>
    </message>
    <message>
        <source>3. Makes line work of the markings.</source>
        <translation>3. 標示から線を作成します。</translation>
    </message>
    <message>
        <source>1. Finds kerbs and other edges along the drive.</source>
        <translation>1. 走行に沿う縁石などの縁を検出します。</translation>
    </message>
    <message>
        <source>5. Makes the areas of the road of edges, lanes and stop lines.</source>
        <translation>5. 縁、車線、停止線から道路の面を作成します。</translation>
    </message>
    <message>
        <source>2. Finds poles, lamp posts, signals, signs and trees.</source>
        <translation>2. 柱、街灯、信号機、標識、樹木を検出します。</translation>
    </message>
    <message>
        <source>4. Makes lanes of the lines and the drive.</source>
        <translation>4. 線と走行から車線を作成します。</translation>
    </message>
    <message>
        <source>Goes from a corrected mobile survey and reference markings to the road as a model, in one run: kerbs, lanes, and of them carriageways, junctions, sidewalks and islands with their steps; and what stands beside the road: poles, lamp posts, signals, signs and trees. All as layers and as CityGML of PLATEAU; the lanes with what stands beside them as Lanelet2 and OpenDRIVE files, too.&lt;/p&gt;&lt;p&gt;This is the same chain as “Road space from a mobile survey”, as a model: the menu Plugins &gt; UrbanMap &gt; Open a chain in the modeller opens a copy to look at and to change.</source>
        <translation>補正済みのMMS計測と基準の路面標示から、道路のモデルまでを一度に作ります。縁石、車線、それらから車道部、交差部、歩道部、島と段差、さらに道路脇の柱、街路灯、信号機、標識、樹木です。すべてレイヤと PLATEAU の CityGML になり、車線は道路脇のものとともに Lanelet2 と OpenDRIVE のファイルにもなります。&lt;/p&gt;&lt;p&gt;「MMS から道路空間」と同じ一連の処理をモデルとしたものです。メニュー「プラグイン &gt; UrbanMap &gt; 処理の流れをモデルデザイナーで開く」で複製を開き、各段階を確認し変更できます。</translation>
    </message>
    <message>
        <source>Road space from a mobile survey (model)</source>
        <translation>MMS から道路空間（モデル）</translation>
    </message>
    <message>
        <source>UrbanMap: mobile mapping and 3D city models</source>
        <translation>UrbanMap: MMS計測と3次元都市モデル</translation>
    </message>
    <message>
        <source>Delivery</source>
        <translation>納品</translation>
    </message>
    <message>
        <source>accuracy</source>
        <translation>精度</translation>
    </message>
    <message>
        <source>acceptance</source>
        <translation>精度管理</translation>
    </message>
    <message>
        <source>quality control</source>
        <translation>品質管理</translation>
    </message>
    <message>
        <source>check points</source>
        <translation>検証点</translation>
    </message>
    <message>
        <source>map level</source>
        <translation>地図情報レベル</translation>
    </message>
    <message>
        <source>report</source>
        <translation>報告書</translation>
    </message>
    <message>
        <source>PDF</source>
        <translation>PDF</translation>
    </message>
    <message>
        <source> Default: {0}.</source>
        <translation> 既定値: {0}。</translation>
    </message>
    <message>
        <source>no</source>
        <translation>いいえ</translation>
    </message>
    <message>
        <source>Judges a survey or building models by check points, in the form of the tables of quality control of Japan's public surveys: figures in plan and in height apart, the limits of the map level, passed or failed for each criterion, a map of the errors, all points.
A mobile survey is judged by control points: with its trajectory, and a corrected one where there is one, the residuals are worked out here.
Check points must have been measured independently; those that the product was adjusted to are left out where a column “role” names them. Where there are too few points nothing is accepted.
The standard deviation is that about a mean of 0. With few points it says little: the report gives the value that it is below with a confidence of 95 %.
Building models without check points yet: their edges are drawn at random, 21 of each quarter regional mesh, into a table in which the survey fills in what it measured. That table is then given as check points.
Building models with laser points instead: 84 edges of each mesh are looked for in the points, and the models judged by those that the points show. If the models were made from the same points, that checks the modelling and not the accuracy, and nothing is judged.</source>
        <translation>計測成果または建物モデルを検証点により判定し、公共測量の精度管理表の形式で示します：水平位置と標高それぞれの値、地図情報レベルの制限値、項目ごとの合否、較差の分布図、全点の一覧。
MMS計測は検証点で判定します：軌跡と、あれば補正後の軌跡を指定すると、残差をここで計算します。
検証点は独立に測量した点とします。role列で調整に用いたとされた点は除外します。点数が足りない場合は合格としません。
標準偏差は母平均を0とした値です。点数が少ない場合は、95 %の信頼度で標準偏差の上限となる値も示します。
検証点のまだない建物モデルでは、4分の1地域メッシュごとに21辺を無作為に抽出し、点検測量の結果を記入する表を作ります。記入した表を検証点として指定します。
検証点の代わりにレーザ点群を使う場合：メッシュごとに 84 辺を点群の中で探し、点群に現れた辺で建物モデルを判定します。モデルが同じ点群から作られている場合はモデリングの点検であって精度の点検ではなく、判定はしません。</translation>
    </message>
    <message>
        <source>Input</source>
        <translation>入力</translation>
    </message>
    <message>
        <source>Output</source>
        <translation>出力</translation>
    </message>
    <message>
        <source>Aerial reference</source>
        <translation>空中写真の基準</translation>
    </message>
    <message>
        <source>ALS</source>
        <translation>航空レーザ</translation>
    </message>
    <message>
        <source>lidar</source>
        <translation>ライダー</translation>
    </message>
    <message>
        <source>control points</source>
        <translation>標定点</translation>
    </message>
    <message>
        <source>height offset</source>
        <translation>高さのずれ</translation>
    </message>
    <message>
        <source>calibration</source>
        <translation>校正</translation>
    </message>
    <message>
        <source>shift</source>
        <translation>移動量</translation>
    </message>
    <message>
        <source>Shifts an airborne laser point cloud to few control points. Where a point has only its true coordinates, the height of the cloud is measured there: a plane through the ground points around it. Where the point was found in the cloud, too (a roof's corner, a marking), its place there tells the shift in plan.
Each control point is left out once and predicted by the others; points that contradict the others are named and not followed. Check points are only compared. Few or clustered points are told.
All points are shifted alike and keep their attributes. Give the result to “Surface and ground from ALS” or “Road markings from aerial frames”.</source>
        <translation>航空レーザ点群を少数の調整点に合わせて移動します。真の座標だけがある点では、まわりの地面の点に平面を当てはめて点群の高さを測ります。点群の中でも見つけた点（屋根の角、路面標示など）は、その位置から水平の移動量が分かります。
各調整点は一度ずつ除外し、残りの点から予測します。ほかと矛盾する点は名前を挙げ、採用しません。検証点は比較だけに使います。点が少ない場合や一か所に集まっている場合は知らせます。
すべての点を同じ量だけ移動し、属性はそのまま残します。結果は「航空レーザからの表層と地表」や「空中写真からの路面標示」に使います。</translation>
    </message>
    <message>
        <source>Javanmardi, 6.1 (calibration of the aerial data with few ground control points)</source>
        <translation>Javanmardi, 6.1（少数の標定点による航空データの校正）</translation>
    </message>
    <message>
        <source>aerial</source>
        <translation>空中写真</translation>
    </message>
    <message>
        <source>frames</source>
        <translation>写真</translation>
    </message>
    <message>
        <source>bundle adjustment</source>
        <translation>バンドル調整</translation>
    </message>
    <message>
        <source>exterior orientation</source>
        <translation>外部標定</translation>
    </message>
    <message>
        <source>Corrects the exterior orientation of aerial frames by few control points whose places in the frames were measured. All frames share a shift and a tilt, each has errors of its own; how much they share is found from the points. Points without coordinates tie frames to each other.
Each control point is left out once and predicted by the others: that figure, or check points, tells what the orientation is worth away from the points. Points that contradict the others, too few of them, and points that lie close together are told.
Give the corrected orientation to “Orthorectify frames” or “Road markings from aerial frames”.</source>
        <translation>写真上の位置を測った少数の標定点により、空中写真の外部標定要素を補正します。全写真に共通のずれと傾きがあり、写真ごとにも誤差があります。共通の割合は点から求めます。座標のない点は写真どうしを結びます。
各標定点は1回ずつ除き、残りの点から予測します。この値、または検証点の誤差が、点から離れた場所での精度を示します。ほかと矛盾する点、点の不足、点の偏りは知らせます。
補正した外部標定要素は「空中写真のオルソ化」または「空中写真からの道路標示」に渡してください。</translation>
    </message>
    <message>
        <source>Javanmardi, 6.1 (calibration of the aerial data with few ground control points); bundle adjustment</source>
        <translation>Javanmardi, 6.1（少数の地上標定点による空中データの調整）、バンドル調整</translation>
    </message>
    <message>
        <source>Mobile mapping</source>
        <translation>MMS計測</translation>
    </message>
    <message>
        <source>MMS</source>
        <translation>MMS</translation>
    </message>
    <message>
        <source>mobile</source>
        <translation>移動体</translation>
    </message>
    <message>
        <source>adjustment</source>
        <translation>調整</translation>
    </message>
    <message>
        <source>network</source>
        <translation>ネットワーク</translation>
    </message>
    <message>
        <source>tie</source>
        <translation>タイポイント</translation>
    </message>
    <message>
        <source>control</source>
        <translation>標定点</translation>
    </message>
    <message>
        <source>trajectory</source>
        <translation>軌跡</translation>
    </message>
    <message>
        <source>strip</source>
        <translation>コース</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>はい</translation>
    </message>
    <message>
        <source>Corrects several drives of a mobile survey at once. Road markings that two drives saw, or one drive twice, tie them to each other, and so do facades and road as planes; control points and reference markings place them. All go into one least-squares adjustment, in which each trajectory drifts as GNSS and inertial units do.
With outlines or models of buildings the facades that the drives saw are laid on their walls; how far they stand inside is found. Without control points, reference markings and buildings the drives agree with each other, but their place is only relative: the result says so.
The corrected trajectories keep the names, formats and epochs of those given; apply them with “Apply corrected trajectory”.</source>
        <translation>MMS計測の複数の走行を同時に補正します。2つの走行で、または1つの走行で2回見えた路面標示が走行どうしを結び付け、平面としての壁面と路面も同様に働きます。基準点と基準の路面標示がその位置を定めます。すべてを1つの最小二乗法による調整に入れ、各軌跡はGNSSと慣性装置に応じてドリフトするものとします。
建物の外周線またはモデルを指定すると、走行で見えた壁面をその壁に合わせます。壁面が外周線のどれだけ内側にあるかも求めます。基準点、基準の路面標示、建物のいずれもない場合、走行どうしは一致しますが、位置は相対的なものにとどまり、結果にその旨を示します。
補正軌跡は、入力した軌跡の名称、形式、エポックを保持します。「補正軌跡の適用」で適用してください。</translation>
    </message>
    <message>
        <source>network adjustment on the registration of Javanmardi, 3.2.4 and 4</source>
        <translation>Javanmardi、3.2.4、4の位置合わせに基づく網平均</translation>
    </message>
    <message>
        <source>GNSS</source>
        <translation>GNSS</translation>
    </message>
    <message>
        <source>GPS</source>
        <translation>GPS</translation>
    </message>
    <message>
        <source>RINEX</source>
        <translation>RINEX</translation>
    </message>
    <message>
        <source>wall</source>
        <translation>壁</translation>
    </message>
    <message>
        <source>facade</source>
        <translation>壁面</translation>
    </message>
    <message>
        <source>parapet</source>
        <translation>パラペット</translation>
    </message>
    <message>
        <source>multipath</source>
        <translation>マルチパス</translation>
    </message>
    <message>
        <source>reflection</source>
        <translation>反射</translation>
    </message>
    <message>
        <source>ray tracing</source>
        <translation>レイトレーシング</translation>
    </message>
    <message>
        <source>Puts walls of building models where reflected satellite signals say they are: models made from roofs have their walls at the parapets, about a metre off.
The code measurement of a signal that a wall has reflected is too long by twice the distance to the wall times a cosine. Only signals that are blocked for sure and that exactly one wall can have reflected are used; those of a satellite within half a minute count as one. A wall is adjusted if there are enough of them, of several satellites and passes, with one answer. Where they tell enough without deciding it is “likely”: moved too, with a larger standard deviation. All other walls stay where they are, with the reason. Buildings stay closed: neighbouring edges follow.
Give as many passes as there are: with one or two nothing is moved, about ten are needed for a wall.</source>
        <translation>屋根から作った建物モデルの壁はパラペットの位置にあり、1 mほどずれています。反射した衛星信号から壁の位置を求めて動かします。
壁で反射した信号のコード観測は、壁までの距離の2倍に余弦を掛けた分だけ長くなります。確実に遮られ、反射し得る壁がただ1枚の信号だけを使い、同じ衛星の30秒以内の信号は1つと数えます。観測が十分にあり、衛星とパスが複数で、答えが1つなら壁を「調整」します。決まらなくても十分に分かる場合は「推定」とし、大きめの標準偏差を付けて動かします。その他の壁は理由を付けて元の位置に残します。建物は閉じたままで、隣の辺も追従します。
パスはあるだけ指定してください。1、2本では何も動かず、1枚の壁に10本ほど必要です。</translation>
    </message>
    <message>
        <source>Javanmardi, 5.6</source>
        <translation>Javanmardi、5.6</translation>
    </message>
    <message>
        <source>road</source>
        <translation>道路</translation>
    </message>
    <message>
        <source>marking</source>
        <translation>路面標示</translation>
    </message>
    <message>
        <source>orthophoto</source>
        <translation>オルソ画像</translation>
    </message>
    <message>
        <source>reference</source>
        <translation>基準</translation>
    </message>
    <message>
        <source>workflow</source>
        <translation>一連の処理</translation>
    </message>
    <message>
        <source>Goes from aerial frames and airborne laser points to the reference that mobile surveys are tied to, in one run: surface and ground from ALS, orthophoto of the ground that the frames see, without moving vehicles, and road markings with their heights.
Frames, points and outlines must be in one projected coordinate system in metres.</source>
        <translation>空中写真と航空レーザ点群から、MMS計測の位置の基準となる成果までを一度に作成します: 航空レーザからの表層と地表、写真に写る地表のオルソ画像（移動車両なし）、高さ付きの路面標示。
写真、点群、外周線は、メートル単位の同じ投影座標系としてください。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.2.1, 3.2.2 and 4.1</source>
        <translation>Javanmardi、3.2.1、3.2.2、4.1</translation>
    </message>
    <message>
        <source>Apply corrected trajectory</source>
        <translation>補正軌跡の適用</translation>
    </message>
    <message>
        <source>correction</source>
        <translation>補正</translation>
    </message>
    <message>
        <source>georeferencing</source>
        <translation>座標付け</translation>
    </message>
    <message>
        <source>survey</source>
        <translation>測量</translation>
    </message>
    <message>
        <source>LAZ</source>
        <translation>LAZ</translation>
    </message>
    <message>
        <source>images</source>
        <translation>画像</translation>
    </message>
    <message>
        <source>Moves the points of a survey, and the poses of its images, from the trajectory with which they were placed to the corrected one.
Only coordinates change: attributes, extra dimensions, header records and the order of the points are kept. Several files are written as one, one after the other. The files may be larger than memory. The GPS times of the points may be seconds of the week or adjusted standard time.</source>
        <translation>計測の点群とその画像の位置姿勢を、座標付けに用いた軌跡から補正軌跡へ移します。
変わるのは座標だけで、属性、追加次元、ヘッダのレコード、点の順序は保持されます。複数のファイルは順につないで1つに書き出します。ファイルはメモリより大きくても構いません。点のGPS時刻は、週内秒でも補正標準時（adjusted standard time）でも構いません。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.2.4.3</source>
        <translation>Javanmardi、3.2.4.3</translation>
    </message>
    <message>
        <source>building</source>
        <translation>建物</translation>
    </message>
    <message>
        <source>3D</source>
        <translation>3次元</translation>
    </message>
    <message>
        <source>solid</source>
        <translation>実線</translation>
    </message>
    <message>
        <source>LOD1</source>
        <translation>LOD1</translation>
    </message>
    <message>
        <source>OBJ</source>
        <translation>OBJ</translation>
    </message>
    <message>
        <source>model</source>
        <translation>モデル</translation>
    </message>
    <message>
        <source>Joins roof polygons at their heights to closed solids that stand on the ground.
Each solid is checked: closed, planar, oriented outwards, no self-intersection. Where points are given, every building carries how well its model fits them. A building that cannot be modelled keeps its row, with the reason in words.</source>
        <translation>高さをもつ屋根ポリゴンから、地面の上に立つ閉じた立体を作成します。
各立体について、閉合、平面性、外向きの面、自己交差のないことを検査します。点群を指定した場合は、建物ごとにモデルの適合度を示します。モデルを作成できない建物も行を残し、理由を文で示します。</translation>
    </message>
    <message>
        <source>Javanmardi, 5.3.4</source>
        <translation>Javanmardi、5.3.4</translation>
    </message>
    <message>
        <source>footprint</source>
        <translation>建物外形</translation>
    </message>
    <message>
        <source>outline</source>
        <translation>外周線</translation>
    </message>
    <message>
        <source>detection</source>
        <translation>抽出</translation>
    </message>
    <message>
        <source>Finds the buildings in airborne laser points and draws their outlines, where there is no register of outlines or an old one.
Points of class 6 are taken where the cloud has them. In other clouds roofs are told from trees by their surfaces: large and smooth ones whose points end their pulses. Roofs that touch make one outline, as party walls cannot be seen from above. An outline is that of the roof, which may hang over the wall, made straight and square where the points say so.
What may be a vehicle, a bridge or a ship keeps its outline and says so in its status.</source>
        <translation>航空レーザ点群から建物を抽出し、外周線を描きます。外周線の台帳がない場所、または台帳が古い場所で使います。
分類された点群ではクラス6の点を使います。そのほかの点群では、面によって屋根と樹木を見分けます。屋根の面は大きく滑らかで、パルスの最後の反射です。上空からは共有壁が見えないため、接する屋根は1つの外周線になります。外周線は屋根の範囲で、壁より張り出すことがあります。点群が示す場合は、直線的で直角の形に整えます。
車両、橋、船の可能性があるものも外周線を残し、状態に記します。</translation>
    </message>
    <message>
        <source>Javanmardi, 5.3.3</source>
        <translation>Javanmardi、5.3.3</translation>
    </message>
    <message>
        <source>LOD2</source>
        <translation>LOD2</translation>
    </message>
    <message>
        <source>Goes from airborne laser points and rough outlines to closed 3D building models in one run: segment buildings, segment roofs, roof polygons, building models.
The method “paper” runs the paper's way whole: all points in the expanded outlines, the histogram alone, alpha shape and Hough lines, the highest point.
The same chain is there as a model that can be changed in the modeller.</source>
        <translation>航空レーザ点群と概略の外周線から、閉じた3次元建物モデルまでを一度に作成します: 建物の抽出、屋根の分割、屋根ポリゴン、建物モデル。
方法paperでは、全体を論文のとおりに処理します: 拡張した外周線内の全点、ヒストグラムのみ、アルファシェイプとハフ変換による線、最高点。
同じ一連の処理は、モデルデザイナーで変更できるモデルとしても用意されています。</translation>
    </message>
    <message>
        <source>Javanmardi, chapter 5</source>
        <translation>Javanmardi、5章</translation>
    </message>
    <message>
        <source>boresight</source>
        <translation>ボアサイト</translation>
    </message>
    <message>
        <source>lever arm</source>
        <translation>レバーアーム</translation>
    </message>
    <message>
        <source>scanner</source>
        <translation>スキャナ</translation>
    </message>
    <message>
        <source>Corrects boresight angles and lever arms of scanners on a vehicle. Small planes of road and walls that two scanners saw, or one scanner in passes of different directions, must coincide; the trajectory of each pass may be off as well.
Drive a street with walls in both directions, correct the trajectories (“Adjust several drives” or “Register mobile survey”) and place the points with them first. A misalignment of the inertial unit that all passes have in common becomes part of the boresight.
What the drives do not determine keeps its value and is called so: heights of lever arms mostly need control points.</source>
        <translation>車両に搭載したスキャナのボアサイト角とレバーアームを補正します。2台のスキャナで、または方向の異なる走行の1台のスキャナで見えた路面と壁面の小平面が一致するようにします。各走行の軌跡のずれも考慮します。
まず壁面のある通りを両方向に走行し、軌跡を補正して（「複数走行の調整」または「MMS計測の位置合わせ」）、点群の座標を付け直してください。全走行に共通する慣性装置の取付けのずれは、ボアサイトに含まれます。
走行から決まらないものは元の値を保ち、その旨を示します。レバーアームの高さの決定には、多くの場合、基準点が必要です。</translation>
    </message>
    <message>
        <source>least-squares adjustment of planes seen from different sides</source>
        <translation>異なる側から見た平面の最小二乗調整</translation>
    </message>
    <message>
        <source>PLATEAU</source>
        <translation>PLATEAU</translation>
    </message>
    <message>
        <source>quality</source>
        <translation>品質</translation>
    </message>
    <message>
        <source>validation</source>
        <translation>検証</translation>
    </message>
    <message>
        <source>check</source>
        <translation>検証点</translation>
    </message>
    <message>
        <source>i-UR</source>
        <translation>i-UR</translation>
    </message>
    <message>
        <source>delivery</source>
        <translation>納品</translation>
    </message>
    <message>
        <source>lane</source>
        <translation>車線</translation>
    </message>
    <message>
        <source>HD map</source>
        <translation>高精度地図</translation>
    </message>
    <message>
        <source>vector map</source>
        <translation>ベクトル地図</translation>
    </message>
    <message>
        <source>Lanelet2</source>
        <translation>Lanelet2</translation>
    </message>
    <message>
        <source>Autoware</source>
        <translation>Autoware</translation>
    </message>
    <message>
        <source>品質</source>
        <translation>品質</translation>
    </message>
    <message>
        <source>検査</source>
        <translation>検査</translation>
    </message>
    <message>
        <source>都市モデル</source>
        <translation>都市モデル</translation>
    </message>
    <message>
        <source>Checks a city model or a lane map, whichever the file is, and tells what breaks the rules, with its place.
CityGML files of PLATEAU (buildings, roads, city furniture; the common rules on all others) are checked by the requirements of the standard product specification that a file alone can show, under its own codes (C01 to T-bldg-02). The page “Rules of city models” of the documentation lists all, and what is not checked because it needs other data or eyes. Code lists are those beside the files (../../codelists); where the data set brings none, those that the specification prints. References, ids and overlaps are looked at over all files of a folder or zip. Solids that overlap are told by their plans and heights.
Lanelet2 files (OSM) are checked by the rules of Lanelet2's and Autoware's validators that need no other file, with their codes and severities, and by some of our own; the page “Rules of lane maps” lists all. Errors hinder a reader or change the map's sense; warnings are missing tags, values that are not known, points that fall together, odd widths, lanelets without a next and a previous one; infos are ends of the map and elements that need Autoware's extension.</source>
        <translation>ファイルの内容に応じて3D都市モデルまたは車線地図を検査し、規則に反する箇所を位置とともに示します。
PLATEAU の CityGML ファイル（建築物、道路、都市設備。そのほかは共通規則）を、標準製品仕様書の品質要求のうちファイルだけで判定できるものについて仕様書の番号（C01～T-bldg-02）で検査し、適合しない箇所を位置とともに示します。規則の一覧と、ほかのデータや目視が必要なため検査しないものは、説明書の「3D都市モデルの規則」にあります。コードリストはファイルに添えられたもの（../../codelists）を使い、データセットにない場合は仕様書に記載のものを使います。参照、識別子、重なりはフォルダ又は zip の全ファイルを通して調べます。立体の重なりは平面形と高さで判定します。
任意の Lanelet2 ファイル（OSM）を、ほかのファイルを要しない Lanelet2 と Autoware の検証規則（コードと重大度も同じ）および独自の規則で検査し、違反とその位置を示します。規則の一覧は説明書の「Rules of lane maps」にあります。エラーは読み込みを妨げるか地図の意味を変えるものです：id の重複、ファイルにないものへの参照、座標として誤った値、左右の境界が1本ずつない lanelet、交わる境界、Lanelet2 が作れない regulatory element、どの規則からも参照されない停止線・横断歩道・領域。警告：タグの欠け、知られていない値、重なる点、不自然な幅、前後につながらない lanelet。情報：地図の端、Autoware の拡張が必要な要素。</translation>
    </message>
    <message>
        <source>Project PLATEAU, standard product specification of 3D city models 5.0, chapters 4, 6 and 7</source>
        <translation>Project PLATEAU 3D都市モデル標準製品仕様書 第5.0版、4章、6章、7章</translation>
    </message>
    <message>
        <source>Road map</source>
        <translation>道路地図</translation>
    </message>
    <message>
        <source>change detection</source>
        <translation>変化抽出</translation>
    </message>
    <message>
        <source>difference</source>
        <translation>差分</translation>
    </message>
    <message>
        <source>update</source>
        <translation>更新</translation>
    </message>
    <message>
        <source>Compares a lane map with an older or foreign one: lines, stop lines, crosswalks and symbols that moved, were added, removed or painted otherwise, with places, shifts and how significant they are. Each map is a Lanelet2 file or layers: lines of “Lines from road markings” or bounds of “Lane map”, and areas.
An offset of the whole map is found first and told once; elements are compared without it. A shift is told where it exceeds three times its sigma, which is that of both maps together; sigma of elements that state none is found from what did not change, and sigmas that are too small for what did not change are enlarged. Nothing is added or removed where the other map has no line of about the same course within 15 m: there it shows no road, unless an area is given that both show.
How lines are cut, sampled and directed does not matter. Of a line only shifts to its side are seen. Two maps from line layers, or two from bounds, agree best: a double line is two lines in the first and one in the second.</source>
        <translation>車線地図を、古い地図や他社の地図と比べます。区画線、停止線、横断歩道、記号の移動・追加・撤去・塗り替えを、位置、移動量、有意性とともに示します。それぞれの地図は Lanelet2 ファイル、またはレイヤ（「路面標示から線」の線、「車線地図」の境界線、および面）で与えます。
まず地図全体のずれを求めて一度だけ示し、要素はそれを除いて比べます。移動は、両方の地図を合わせた標準偏差の 3 倍を超えたときだけ示します。標準偏差のない要素には、変化していない要素から推定した値を使い、変化していない要素のばらつきに比べて小さすぎる標準偏差は大きくします。相手の地図に 15 m 以内でほぼ同じ向きの線がないところは道路が載っていないとみなし、追加・撤去としません（両方の地図が載せる範囲を与えた場合を除く）。
線の切れ方、点の間隔、向きは影響しません。線については横方向の移動だけが分かります。線どうし、境界線どうしの比較が最もよく合います（二重線は前者では 2 本、後者では 1 本）。</translation>
    </message>
    <message>
        <source>Convert heights</source>
        <translation>高さの基準の変換</translation>
    </message>
    <message>
        <source>height</source>
        <translation>高さ</translation>
    </message>
    <message>
        <source>geoid</source>
        <translation>ジオイド</translation>
    </message>
    <message>
        <source>JGD2011</source>
        <translation>JGD2011</translation>
    </message>
    <message>
        <source>JGD2024</source>
        <translation>JGD2024</translation>
    </message>
    <message>
        <source>orthometric</source>
        <translation>正標高</translation>
    </message>
    <message>
        <source>ellipsoidal</source>
        <translation>楕円体高</translation>
    </message>
    <message>
        <source>標高</source>
        <translation>標高</translation>
    </message>
    <message>
        <source>ジオイド</source>
        <translation>ジオイド</translation>
    </message>
    <message>
        <source>標高改定</source>
        <translation>標高改定</translation>
    </message>
    <message>
        <source>Takes heights of point clouds, a raster or a layer from one height system into another, with a grid that you give: GSI's corrections between JGD2011 and JGD2024, or a geoid model.
The result states its height system, and the change is told: its least, mean and largest. In Japan heights of JGD2024 (since April 2025) differ from JGD2011 by up to +57 and -67 cm; plane coordinates are the same.</source>
        <translation>点群、ラスタまたはレイヤの高さを、指定したグリッドを用いて別の高さの基準に変換します。グリッドは、国土地理院によるJGD2011とJGD2024の間の補正パラメータ、またはジオイド・モデルです。
結果には高さの基準を明記し、変化量の最小、平均、最大を示します。日本では、JGD2024（2025年4月から）の標高はJGD2011と最大で+57 cm、-67 cm異なります。平面座標は同じです。</translation>
    </message>
    <message>
        <source>GSI, revision of heights in Japan of April 2025 (JGD2024)</source>
        <translation>国土地理院、2025年4月の標高成果の改定（JGD2024）</translation>
    </message>
    <message>
        <source>Export city model</source>
        <translation>都市モデルの出力</translation>
    </message>
    <message>
        <source>Cesium</source>
        <translation>Cesium</translation>
    </message>
    <message>
        <source>GeoParquet</source>
        <translation>GeoParquet</translation>
    </message>
    <message>
        <source>LOD</source>
        <translation>LOD</translation>
    </message>
    <message>
        <source>Writes building models of any step as CityJSON, CityGML (in Japan as PLATEAU lays it out) and 3D Tiles.
Each building has its levels of detail 0 (outline and roof outline), 1.2, 1.3 and 2.2 side by side, parts where they stand alone, all attributes of the layer, and figures: heights of its roofs, volumes, areas, storeys as estimated. A solid that is not closed is kept as surfaces, and the field “problems” says so.</source>
        <translation>任意の段階の建物モデルを、CityJSON、CityGML（日本ではPLATEAUの仕様による）、3D Tilesで書き出します。
各建物は、詳細度0（外周線と屋根の外形線）、1.2、1.3、2.2を併せてもち、独立した部分は建物部分とし、レイヤの全属性と、屋根の高さ、体積、面積、推定階数などの数値を含みます。閉じていない立体は面のまま保持し、フィールド「problems」にその旨を示します。</translation>
    </message>
    <message>
        <source>Facade textures</source>
        <translation>壁面テクスチャ</translation>
    </message>
    <message>
        <source>Line scanners and line cameras</source>
        <translation>ラインスキャナ・ラインカメラ</translation>
    </message>
    <message>
        <source>texture</source>
        <translation>テクスチャ</translation>
    </message>
    <message>
        <source>line camera</source>
        <translation>ラインカメラ</translation>
    </message>
    <message>
        <source>image</source>
        <translation>画像</translation>
    </message>
    <message>
        <source>glTF</source>
        <translation>glTF</translation>
    </message>
    <message>
        <source>appearance</source>
        <translation>外観</translation>
    </message>
    <message>
        <source>Gives the facades of building models the images of line cameras, of aerial frames, or of both.
Every place of a facade takes the image that shows it in most detail among those from which no other building hides it and, where laser points are given, no tree or vehicle. Brightness is evened out between images, and they pass softly into each other. Places that no image shows stay grey; a facade that none shows gets no texture, and the layer of facades says why.
Trajectory, points and building models must fit together: correct the survey first.</source>
        <translation>建物モデルの壁面に、ラインカメラの画像、空中写真、またはその両方を貼り付けます。
壁面の各箇所には、ほかの建物に隠されず、レーザ点群を指定した場合は樹木や車両にも隠されない画像のうち、最も詳細に写る画像を用います。画像間の明るさをそろえ、継ぎ目を滑らかにします。どの画像にも写らない箇所は灰色のままとし、まったく写らない壁面にはテクスチャを付けず、壁面のレイヤに理由を示します。
軌跡、点群、建物モデルの位置は互いに合っている必要があります。先に計測を補正してください。</translation>
    </message>
    <message>
        <source>Zhao and Shibasaki, 2.2 and 4.2</source>
        <translation>Zhao・Shibasaki、2.2、4.2</translation>
    </message>
    <message>
        <source>vehicles</source>
        <translation>車両</translation>
    </message>
    <message>
        <source>cars</source>
        <translation>自動車</translation>
    </message>
    <message>
        <source>traffic</source>
        <translation>交通</translation>
    </message>
    <message>
        <source>darkest</source>
        <translation>最小輝度</translation>
    </message>
    <message>
        <source>Makes one orthophoto without moving vehicles from several of the same ground: where a vehicle stands in one, another shows the road. Vehicles that stand still in all of them stay.
The others are resampled onto the first, also from another coordinate system, and their exposures are evened out. Pixels without data in one are taken from the others.</source>
        <translation>同じ地表の複数のオルソ画像から、移動車両のない1枚を作成します。1枚で車両がある場所は、別の画像の路面を用います。すべての画像で止まっている車両は残ります。
ほかの画像は、座標参照系が異なる場合も含めて1枚目に合わせて再配列し、露出の違いをそろえます。1枚にデータのない画素は、ほかの画像で補います。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.2.1.2</source>
        <translation>Javanmardi、3.2.1.2</translation>
    </message>
    <message>
        <source>registration</source>
        <translation>位置合わせ</translation>
    </message>
    <message>
        <source>Goes from a mobile survey to the same survey lying on the aerial reference, in one run: its road markings by intensity, their registration to the reference markings, and the points as the corrected trajectory places them.
With ground heights the correction is in space; without them heights stay as they are. The reference is what “Road markings from aerial frames” makes.</source>
        <translation>MMS計測データから、空中写真の基準に位置を合わせたMMS計測データまでを、1回の実行で求めます。反射強度による路面標示の抽出、基準の路面標示との位置合わせ、補正後の軌跡による点群の再配置を行います。
地表の標高を与えると3次元で補正します。与えない場合、高さはそのままです。基準には「空中写真からの路面標示」の結果を用います。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.2.3, 3.2.4 and 4</source>
        <translation>Javanmardi、3.2.3、3.2.4、4</translation>
    </message>
    <message>
        <source>Georeference range scans</source>
        <translation>測距スキャンの座標付け</translation>
    </message>
    <message>
        <source>line scanner</source>
        <translation>ラインスキャナ</translation>
    </message>
    <message>
        <source>laser scanner</source>
        <translation>レーザスキャナ</translation>
    </message>
    <message>
        <source>range</source>
        <translation>斜距離</translation>
    </message>
    <message>
        <source>profile</source>
        <translation>プロファイル</translation>
    </message>
    <message>
        <source>direct georeferencing</source>
        <translation>直接定位</translation>
    </message>
    <message>
        <source>VLMS</source>
        <translation>VLMS</translation>
    </message>
    <message>
        <source>Places raw measurements of line scanners in the map with the vehicle's trajectory and the calibration.
Scans are tables with the columns time (s), angle (degrees), range (m) and, if wanted, intensity and scanner: CSV (also .gz), Parquet where pyarrow is installed, or LAS and LAZ with gps_time, point_source_id and the extra dimensions angle and range. The beam at angle a points along (cos a, sin a, 0) in the scanner's axes.
Position and angles of the vehicle are linear between epochs. What was measured outside the trajectory's time or in gaps of it of more than a second is left out and counted. The points keep angle and range.</source>
        <translation>ラインスキャナの生の測定値を、車両の軌跡と校正値を用いて地図上に配置します。
スキャンは、time (s)、angle (degrees)、range (m) の列と、必要に応じてintensityとscannerの列をもつ表です。CSV（.gzも可）、Parquet（pyarrowがインストールされている場合）、またはgps_time、point_source_idと追加次元angle、rangeをもつLAS・LAZを用います。角度aのビームは、スキャナ座標系の (cos a, sin a, 0) の方向を向きます。
車両の位置と角度はエポック間で線形に補間します。軌跡の時間の外、または1秒を超える軌跡の欠測区間で測定されたものは除き、その数を示します。点はangleとrangeを保持します。</translation>
    </message>
    <message>
        <source>Zhao and Shibasaki, 2.2, eq. 1 and 4 to 7</source>
        <translation>Zhao・Shibasaki、2.2、式1、4～7</translation>
    </message>
    <message>
        <source>NLOS</source>
        <translation>NLOS</translation>
    </message>
    <message>
        <source>satellite</source>
        <translation>衛星</translation>
    </message>
    <message>
        <source>Traces the observed satellite signals among building models: in line of sight, blocked, or reflected once by a wall.
Each signal becomes a 3D line with its excess path as the model predicts it and the residual of its code measurement, after satellite, atmosphere and receiver clock. Signals that are blocked and received all the same have taken another path; where one wall alone can have reflected them, the residual should be the excess path.
The class of a signal near an edge is not sure, as walls of models stand up to a metre or two off.</source>
        <translation>観測された衛星信号を建物モデルの間で追跡し、見通し内、遮蔽、壁面での1回反射に分けます。
各信号は3Dの線となり、モデルから予測される過剰経路長と、衛星・大気・受信機時計の補正後のコード測定の残差をもちます。遮蔽されているのに受信された信号は、別の経路を通ったものです。1つの壁面だけがそれを反射し得た場合、残差は過剰経路長に等しいはずです。
モデルの壁面は1～2 mずれていることがあるため、辺の近くを通る信号の区分は確実ではありません。</translation>
    </message>
    <message>
        <source>ground</source>
        <translation>地表</translation>
    </message>
    <message>
        <source>pavement</source>
        <translation>歩道</translation>
    </message>
    <message>
        <source>cloth</source>
        <translation>布</translation>
    </message>
    <message>
        <source>CSF</source>
        <translation>CSF</translation>
    </message>
    <message>
        <source>classification</source>
        <translation>分類</translation>
    </message>
    <message>
        <source>Tells the ground of a mobile laser survey, roads and pavements alike, from all that stands on it.
A cloth is drawn up against the points from below; points within a threshold of it become class 2. Points of other classes than 0, 1 and 2 keep theirs. All attributes and the order of the points stay.
A street that is driven several times is filtered pass by pass where the points have GPS time, because the passes may lie decimetres apart in height. Small clusters of points below a much denser road (multipath ghosts) are left out. The lowest decimetres of walls and posts count as ground: the threshold cannot tell them. The files may be larger than memory.</source>
        <translation>MMS計測のレーザ点群で、車道・歩道を問わず地表を、その上にあるすべてのものから区別します。
布を下から点群に当て、布からしきい値以内の点をクラス2とします。クラス0、1、2以外の点は元のクラスを保ちます。すべての属性と点の順序はそのままです。
点にGPS時刻がある場合、複数回走行した道路は走行パスごとに処理します。走行パスどうしは高さが数十cmずれていることがあるためです。はるかに密な路面の下にある点の小さな塊（マルチパスによるゴースト点）は除きます。壁や柱の最下部数十cmは、しきい値では区別できないため地表に含まれます。ファイルはメモリより大きくてもかまいません。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.2.3.1; cloth filter: Zhang et al. 2016</source>
        <translation>Javanmardi、3.2.3.1。布シミュレーションフィルタ：Zhangほか 2016</translation>
    </message>
    <message>
        <source>Landmark update</source>
        <translation>標識点による更新</translation>
    </message>
    <message>
        <source>landmark</source>
        <translation>標識点</translation>
    </message>
    <message>
        <source>GCP</source>
        <translation>GCP</translation>
    </message>
    <message>
        <source>baseline</source>
        <translation>従来法</translation>
    </message>
    <message>
        <source>Moves a trajectory so that it meets control points: the usual method, to compare “Register mobile survey” with.
The correction at each control point is its true place less its place in the survey. Between control points it is interpolated over time; before the first and after the last it stays as it is. Angles are not touched. The result is good near control points and follows the error of the survey between them.</source>
        <translation>調整点に合うように軌跡を移動します。「MMS計測の位置合わせ」と比較するための、通常の方法です。
各調整点での補正量は、真の位置から計測データ中の位置を引いたものです。調整点の間では時間で補間し、最初の調整点より前と最後の調整点より後では一定とします。角度は変更しません。結果は調整点の近くでは良好で、その間では計測の誤差に従います。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.1</source>
        <translation>Javanmardi、3.1</translation>
    </message>
    <message>
        <source>OpenDRIVE</source>
        <translation>OpenDRIVE</translation>
    </message>
    <message>
        <source>Goes from reference markings and corrected drives to a lane map, in one run: line work of the markings, then lanes with their bounds, directions and connections, as layers, as Lanelet2 file for Autoware and as OpenDRIVE file.
Markings and ground are what “Road markings from aerial frames” makes; trajectories are what “Georeference mobile survey” makes. What is missing for a lane is a finding with its place: look at them, for no lane is made without evidence.</source>
        <translation>基準の路面標示と補正後の走行から車線地図までを、1回の実行で作成します。路面標示の線、次に境界・方向・接続をもつ車線を作成し、レイヤ、Autoware用のLanelet2ファイル、OpenDRIVEファイルとして出力します。
路面標示と地表は「空中写真からの路面標示」の結果、軌跡は「MMS計測の位置合わせ」の結果を用います。車線に不足しているものは、その位置を示す指摘事項となります。根拠のない車線は作成されないため、指摘事項を確認してください。</translation>
    </message>
    <message>
        <source>Javanmardi, 6.2</source>
        <translation>Javanmardi、6.2</translation>
    </message>
    <message>
        <source>Load city model</source>
        <translation>都市モデルの読込</translation>
    </message>
    <message>
        <source>footprints</source>
        <translation>建物外周線</translation>
    </message>
    <message>
        <source>建築物</source>
        <translation>建築物</translation>
    </message>
    <message>
        <source>Loads buildings of city models as outlines with heights and all attributes, and their solids and surfaces, for the other steps.
CityGML as PLATEAU has it (.gml, .zip or its folder; roads where “Roads” is asked for, city furniture and trees where “Street objects” is; files of other things are passed over), CityJSON and CityJSONSeq are read, levels of detail 0 to 2. Codes get their meaning where the lists are beside the files. A building whose id is not its own, whose solid is not closed or whose parts cannot be read keeps its row; the field “note” says why. Nothing is read from the network.</source>
        <translation>3D都市モデルの建物を、高さと全属性を持つ外周線、立体、面として読み込み、ほかの処理で使えるようにします。
PLATEAU の CityGML（.gml、.zip、そのフォルダ。「道路」を指定したときは道路も、「道路沿いの地物」を指定したときは都市設備と樹木も読み、その他のファイルは読み飛ばします）、CityJSON、CityJSONSeq の LOD0〜2 を読みます。コードリストがファイルのそばにあれば、コードに意味が付きます。ID が重複する建物、立体が閉じていない建物、読めない部分のある建物も行は残り、フィールド「note」に理由が入ります。ネットワークからは何も読みません。</translation>
    </message>
    <message>
        <source>OGC 12-019 (CityGML 2.0), CityJSON 2.0.1</source>
        <translation>OGC 12-019（CityGML 2.0）、CityJSON 2.0.1</translation>
    </message>
    <message>
        <source>Load GSI data</source>
        <translation>国土地理院のデータの読込</translation>
    </message>
    <message>
        <source>GSI</source>
        <translation>国土地理院</translation>
    </message>
    <message>
        <source>FGD</source>
        <translation>FGD</translation>
    </message>
    <message>
        <source>GML</source>
        <translation>GML</translation>
    </message>
    <message>
        <source>JPGIS</source>
        <translation>JPGIS</translation>
    </message>
    <message>
        <source>DEM</source>
        <translation>DEM</translation>
    </message>
    <message>
        <source>elevation</source>
        <translation>標高</translation>
    </message>
    <message>
        <source>基盤地図情報</source>
        <translation>基盤地図情報</translation>
    </message>
    <message>
        <source>数値標高モデル</source>
        <translation>数値標高モデル</translation>
    </message>
    <message>
        <source>国土地理院</source>
        <translation>国土地理院</translation>
    </message>
    <message>
        <source>Loads building outlines and elevation models of the Fundamental Geospatial Data of the Geospatial Information Authority of Japan (GSI) as footprints and as a raster of the ground for the other steps.
Outlines (BldA, BldL) and DEM1A, 5A, 5B, 5C, 10A and 10B are read as downloaded: .xml, .zip (zips in it too), or a folder of them. Outlines become polygons where they close; a building that several map sheets hold, or that is there both as an area and as an outline, comes once. The newest file of a mesh is taken; where finer products have no height, coarser ones fill in. The raster states its height system (JGD2000, JGD2011 or JGD2024). What is left out or changed is told in the log.</source>
        <translation>国土地理院の基盤地図情報の建築物の外周線と数値標高モデルを、ほかの処理で使う建物外周線と地表のラスタとして読み込みます。
建築物（BldA、BldL）とDEM1A、5A、5B、5C、10A、10Bを、ダウンロードしたままのファイル（.xml、.zip（内側のzipも可）、またはそのフォルダ）から読み込みます。外周線は閉じていればポリゴンとし、複数の図郭にある建物や、面と外周線の両方がある建物は1つだけとします。メッシュごとに最新のファイルを用い、細かい製品に標高がないところは粗い製品で補います。ラスタには高さの基準（JGD2000、JGD2011またはJGD2024）が記録されます。除いたものや変更したものはログに示します。</translation>
    </message>
    <message>
        <source>Javanmardi, 5.3.1; GSI, product specification of the Fundamental Geospatial Data</source>
        <translation>Javanmardi, 5.3.1；国土地理院 基盤地図情報ダウンロードデータ ファイル仕様書</translation>
    </message>
    <message>
        <source>localization</source>
        <translation>自己位置推定</translation>
    </message>
    <message>
        <source>localisation</source>
        <translation>位置推定</translation>
    </message>
    <message>
        <source>NDT</source>
        <translation>NDT</translation>
    </message>
    <message>
        <source>ICP</source>
        <translation>ICP</translation>
    </message>
    <message>
        <source>map matching</source>
        <translation>地図照合</translation>
    </message>
    <message>
        <source>reliability</source>
        <translation>信頼性</translation>
    </message>
    <message>
        <source>automated driving</source>
        <translation>自動運転</translation>
    </message>
    <message>
        <source>covariance</source>
        <translation>共分散</translation>
    </message>
    <message>
        <source>DOP</source>
        <translation>DOP</translation>
    </message>
    <message>
        <source>Tells from the map alone where a vehicle will know its place, before anyone drives: standard deviations along and across the road and of the heading, by laser scans matched to walls, by road markings, by satellites, and together.
What matters most is how accurately walls and markings stand in the map: give their sigmas. A wall that is displaced displaces the vehicle however many points it gives.
Places that look alike within the search distance are told with their distance and their share of the probability. A place of which the map tells nothing has no sigma and a status with the reason; a direction of which it tells nothing keeps the sigma from before matching.</source>
        <translation>車両が自己位置を把握できる場所を、走行する前に地図だけから求めます。壁面とのレーザスキャン照合、路面標示、衛星、およびそれらの組合せによる、道路の縦断方向・横断方向の位置と方位角の標準偏差を示します。
最も重要なのは、地図の壁面と路面標示の位置の正確さです。それらのσを指定してください。ずれた壁面は、点がどれだけ多くても車両の位置をずらします。
探索距離内に似た場所がある場合は、その距離と確率の割合を示します。地図から何も分からない場所にはσがなく、状態に理由を示します。何も分からない方向は、照合前のσのままです。</translation>
    </message>
    <message>
        <source>Lines from road markings</source>
        <translation>路面標示からの線</translation>
    </message>
    <message>
        <source>line</source>
        <translation>線</translation>
    </message>
    <message>
        <source>dashed</source>
        <translation>破線</translation>
    </message>
    <message>
        <source>crosswalk</source>
        <translation>横断歩道</translation>
    </message>
    <message>
        <source>stop line</source>
        <translation>停止線</translation>
    </message>
    <message>
        <source>arrow</source>
        <translation>矢印</translation>
    </message>
    <message>
        <source>lane map</source>
        <translation>車線地図</translation>
    </message>
    <message>
        <source>Turns polygons of road markings into line work: centre lines with kind, width, colour and sigma, stop lines, crosswalks, and symbols such as arrows and diamonds.
Pieces of paint that continue each other become one line, also across the gaps of dashes, of wear and of vehicles; how much was bridged is a field. A line is dashed where a periodic pattern explains its paint better than a solid line; begins and ends of the dashes are a field. Centre lines are fitted to cross-sections of the paint and smoothed over 3 m.
How wide the paint is comes from marking points: outlines from images show where a line lies, not how wide it is. A line without points takes what the outlines of lines alike are too wide by; where nothing tells the width to 3 cm it is left empty.
Arrows are told by their shape, and only where one shape is clearly better than the others. Paint that is neither line nor known shape keeps its polygon, with the class unknown.</source>
        <translation>路面標示のポリゴンを線に変換します。種別・幅・色・σをもつ中心線、停止線、横断歩道、および矢印やひし形などの記号を作成します。
互いに続く標示の断片は、破線のすき間、摩耗、車両による途切れを越えて1本の線とします。補間した長さはフィールドに示します。実線よりも周期的なパターンのほうが標示をよく説明する場合に破線とし、破線の各線分の始点と終点をフィールドに示します。中心線は標示の横断面に当てはめ、3 mにわたって平滑化します。
標示の幅はマーキング点群から求めます。画像から得た輪郭は線の位置を示しますが、幅は示しません。点群のない線には、似た線の輪郭が実際より広い分を差し引いた値を与えます。3 cm の精度で決められない幅は空欄とします。
矢印は形状で判別し、1つの形状がほかより明らかに適合する場合に限ります。線でも既知の形状でもない標示は、クラスunknownとしてポリゴンのまま残します。</translation>
    </message>
    <message>
        <source>merge</source>
        <translation>統合</translation>
    </message>
    <message>
        <source>Joins building models from airborne scanning with walls measured from the street: below a height the walls lie where the survey found them, above it the models stay as they were.
Walls move within stated limits and never into a neighbour. A roof that stands out over the measured wall stays, with a level underside; so does what stands out at the height. Walls that were not driven past stay and are marked; where satellites tell them (“Adjust walls by GNSS”), they move, weighed by their sigma.
Every result is checked: closed, planar, oriented outwards, no self-intersection. A building that cannot be merged keeps its model and says why.</source>
        <translation>航空レーザ測量による建物モデルと、道路から計測した壁面を統合します。指定の高さより下では壁面を計測された位置に置き、それより上ではモデルをそのまま保ちます。
壁面は指定の限度内で移動し、隣の建物に入り込むことはありません。計測壁面から張り出す屋根は、下面を水平にして残します。指定の高さで張り出す部分も同様です。そばを走行していない壁面はそのまま残り、その旨を示します。衛星から位置が分かる壁面（「GNSSによる壁面の調整」）は、その標準偏差に応じて移動します。
すべての結果について、閉じていること、平面であること、外向きであること、自己交差がないことを検査します。統合できない建物は元のモデルを保ち、理由を示します。</translation>
    </message>
    <message>
        <source>Javanmardi, 5.7</source>
        <translation>Javanmardi、5.7</translation>
    </message>
    <message>
        <source>mesh</source>
        <translation>メッシュ</translation>
    </message>
    <message>
        <source>2.5D</source>
        <translation>2.5D</translation>
    </message>
    <message>
        <source>TIN</source>
        <translation>TIN</translation>
    </message>
    <message>
        <source>curved</source>
        <translation>曲面</translation>
    </message>
    <message>
        <source>complex</source>
        <translation>複雑な形状</translation>
    </message>
    <message>
        <source>PLY</source>
        <translation>PLY</translation>
    </message>
    <message>
        <source>Makes closed meshes of complex or curved buildings from their points: triangulated roofs, upright walls where the heights step, a level ground.
The mesh is simplified as far as the stated error allows: at least 95 % of a building's uppermost points shall lie within it. Where that cannot be reached, as with what stands on roofs, the building says so; so it does of a second surface under the first, which has no place in a 2.5D mesh.
Points with building_id are taken by their number; from others the outlines cut their points, of classified ones those of class 6.</source>
        <translation>複雑な形状や曲面の建物の閉じたメッシュを点群から作成します。屋根は三角網、高さの段差は鉛直な壁面、下面は水平とします。
メッシュは指定の誤差の範囲で簡略化します。建物の最上部の点の95 %以上がその誤差内に収まるようにします。屋上の設置物などで達成できない場合は、その建物に示します。2.5Dメッシュでは表せない、1つ目の面の下にある2つ目の面がある場合も同様です。
building_idをもつ点はその番号で用います。それ以外は外周線で点を切り出し、分類済みの場合はクラス6の点を用います。</translation>
    </message>
    <message>
        <source>Objects from images</source>
        <translation>画像からの地物</translation>
    </message>
    <message>
        <source>sign</source>
        <translation>標識</translation>
    </message>
    <message>
        <source>signal</source>
        <translation>信号</translation>
    </message>
    <message>
        <source>light</source>
        <translation>照明灯</translation>
    </message>
    <message>
        <source>kerb</source>
        <translation>縁石</translation>
    </message>
    <message>
        <source>object</source>
        <translation>地物</translation>
    </message>
    <message>
        <source>laser</source>
        <translation>レーザ</translation>
    </message>
    <message>
        <source>Brings outlines that were drawn on line images or frames into the map: sign boards, signals and lights as polygons or points, kerbs as lines.
Laser points are projected into the image; those inside the outline and on the nearest connected surface give the outline its place, size, orientation and height. All fields of the outlines are kept.
Open the image in QGIS without a coordinate reference system and draw on it: x runs along the columns, y is negative downwards. A field image names the file where there are several.
Images and points must be placed by the same trajectory.</source>
        <translation>ライン画像または空中写真の上に描いた輪郭を地図に移します。看板・信号機・照明灯はポリゴンまたは点、縁石は線となります。
レーザ点を画像に投影し、輪郭の内側にあって最も近い連続した面上の点から、輪郭の位置・大きさ・向き・高さを求めます。輪郭のすべてのフィールドを保ちます。
画像を座標参照系なしでQGISに開き、その上に描いてください。xは列の方向、yは下方向が負です。画像が複数ある場合は、フィールドimageにファイル名を入れます。
画像と点は同じ軌跡で配置されている必要があります。</translation>
    </message>
    <message>
        <source>Zhao and Shibasaki, 4.2</source>
        <translation>Zhao・Shibasaki、4.2</translation>
    </message>
    <message>
        <source>Occlusion map of a frame</source>
        <translation>写真の遮蔽図</translation>
    </message>
    <message>
        <source>perspective occlusion map</source>
        <translation>遮蔽図</translation>
    </message>
    <message>
        <source>POM</source>
        <translation>POM</translation>
    </message>
    <message>
        <source>relief displacement</source>
        <translation>倒れ込み</translation>
    </message>
    <message>
        <source>building lean</source>
        <translation>建物の倒れ込み</translation>
    </message>
    <message>
        <source>hidden</source>
        <translation>隠蔽</translation>
    </message>
    <message>
        <source>visibility</source>
        <translation>可視性</translation>
    </message>
    <message>
        <source>mask</source>
        <translation>マスク</translation>
    </message>
    <message>
        <source>photograph</source>
        <translation>写真</translation>
    </message>
    <message>
        <source>Masks the pixels of an aerial frame that show a building or the ground that a building hides.
The surface that is higher above the ground than the threshold is projected into the frame with its camera and exterior orientation, lens distortion included, and filled, walls too. Trees and bridges as high as that are masked as well.
The edges are as good as the surface: use a resolution near the distance between the laser points. Building outlines add low buildings and roofs with missing points. The mask has the rows and columns of the frame and no place in the world.</source>
        <translation>空中写真のうち、建物、または建物が隠す地表が写る画素をマスクします。
地表からの高さがしきい値を超える表層を、カメラと外部標定要素により（レンズ歪みを含めて）空中写真に投影し、壁面も含めて塗りつぶします。同じ高さの樹木や橋もマスクされます。
縁の精度は表層の精度によります。解像度はレーザ点の間隔程度としてください。建物外周線を与えると、低い建物や点の欠けた屋根も加わります。マスクは空中写真と同じ行数・列数で、地図上の位置をもちません。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.2.1.1, eq. 1 to 3</source>
        <translation>Javanmardi、3.2.1.1、式1～3</translation>
    </message>
    <message>
        <source>orthorectification</source>
        <translation>オルソ補正</translation>
    </message>
    <message>
        <source>true ortho</source>
        <translation>トゥルーオルソ</translation>
    </message>
    <message>
        <source>mosaic</source>
        <translation>モザイク</translation>
    </message>
    <message>
        <source>Lays aerial frames on the ground as one mosaic. Ground that a building, tree or bridge hides from one frame is taken from another that sees it; buildings themselves and ground that no frame sees hold no data (0).
Differences in exposure between frames are evened out first. With the vehicle filter moving vehicles go, because another frame shows the road where they stood; vehicles that stand still in all frames stay.
Frames, ground and surface must be in one projected coordinate system in metres.</source>
        <translation>空中写真を地表に投影し、1枚のモザイクとします。建物・樹木・橋が1枚の写真で隠す地表は、それが写る別の写真から補います。建物自体と、どの写真にも写らない地表はノーデータ（0）です。
写真間の露出の違いは先に調整します。車両フィルタを用いると、別の写真に車両のいた場所の路面が写るため、移動する車両は消えます。すべての写真で停車している車両は残ります。
空中写真、地表、表層は、同一の投影座標系（メートル単位）である必要があります。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.2.1</source>
        <translation>Javanmardi、3.2.1</translation>
    </message>
    <message>
        <source>overlay</source>
        <translation>重ね描き</translation>
    </message>
    <message>
        <source>frame</source>
        <translation>空中写真</translation>
    </message>
    <message>
        <source>building frames</source>
        <translation>建物の枠線</translation>
    </message>
    <message>
        <source>before</source>
        <translation>補正前</translation>
    </message>
    <message>
        <source>after</source>
        <translation>補正後</translation>
    </message>
    <message>
        <source>Draws laser points and the edges of building models or other lines on line images, frames and orthophotos, so that one sees whether they fit.
Edges that a building hides are left out, and points behind a nearer surface. With what was before a correction (trajectory, points, lines) each picture is made twice, and the page switches between them.
Points are read once; each image keeps the nearest point of every 3 by 3 pixels.</source>
        <translation>レーザ点と、建物モデルの辺やその他の線を、ライン画像・空中写真・オルソ画像の上に描き、合っているかどうかを確認できるようにします。
建物に隠れる辺と、手前の面の後ろにある点は除きます。補正前のもの（軌跡、点、線）を与えると、各画像を2通り作成し、ページ上で切り替えられます。
点は一度だけ読み込みます。各画像は3×3画素ごとに最も近い点を保持します。</translation>
    </message>
    <message>
        <source>Zhao and Shibasaki, 4.1 and 4.2</source>
        <translation>Zhao・Shibasaki、4.1、4.2</translation>
    </message>
    <message>
        <source>tie points</source>
        <translation>タイポイント</translation>
    </message>
    <message>
        <source>drift</source>
        <translation>ドリフト</translation>
    </message>
    <message>
        <source>INS</source>
        <translation>INS</translation>
    </message>
    <message>
        <source>Corrects position and heading of a survey's trajectory by tie points: places, such as corners of buildings, that the survey and a reference both show. Two or more pairs measured within some seconds are a set.
By default the drift is estimated from all tie points together, each at its own time, with its sigma at every epoch; contradicting pairs and sets are found and told. “paper” follows the paper to the letter: the first two pairs of each set give a true pose by its equations 13 to 17, the relative motions between two of them take their parts of the error by the iteration of its equations 8 and 9, heights are sampled equally, and nothing is left out as wrong. Before the first and after the last set the correction is carried on, and its sigma grows.
With a ground raster the heights then follow the ground along the course, at the given height of the trajectory's origin above it. Roll and pitch stay as they are.</source>
        <translation>計測データの軌跡の位置と方位角を、タイポイント（建物の角など、計測データと基準の両方に写る場所）により補正します。数秒以内に計測された2組以上の対応点を、1つの組とします。
既定では、すべてのタイポイントをそれぞれの時刻で用いてドリフトを一括推定し、各エポックのσを求めます。矛盾する対応点と組は検出して示します。「paper」は論文に忠実に従います。各組の最初の2つの対応点から式13～17で真の位置姿勢を求め、2つの組の間の相対運動に式8、9の反復計算で誤差を配分し、高さは等間隔に標本化し、誤りとして除くものはありません。最初の組より前と最後の組より後では補正を延長し、そのσは増大します。
地表のラスタを与えると、高さは走行軌跡に沿った地表に、指定した軌跡の原点の地上高を加えたものとなります。ロールとピッチはそのままです。</translation>
    </message>
    <message>
        <source>Zhao and Shibasaki, 3, eq. 8 to 17</source>
        <translation>Zhao・Shibasaki、3、式8～17</translation>
    </message>
    <message>
        <source>Finds how the trajectory of a mobile survey is off, by laying its road markings on those of an aerial reference, and corrects it.
The driven path is cut into short patches; each is registered with a window of patches round it that is as long as its markings need. The windows' results become one smooth correction over the path: stretches that contradict the rest lose their weight, gaps are bridged with growing uncertainty, and each patch says how its correction was found and how sure it is.
With ground heights (a raster, or polygons with heights) the correction is in space; without them heights, roll and pitch stay as they are. With outlines or models of buildings the facades that the survey saw are a second witness beside the markings: they hold the survey where there is no paint, and where both disagree nothing is called registered. Apply the result with “Apply corrected trajectory”.</source>
        <translation>MMS計測の路面標示を空中写真の基準の路面標示に重ねて、MMS計測の軌跡のずれを求め、補正します。
走行経路を短いパッチに分け、各パッチを、路面標示が必要とするだけの長さをもつ前後のパッチのウィンドウで位置合わせします。ウィンドウの結果は、経路に沿った1つの滑らかな補正にまとめます。ほかと矛盾する区間は重みを失い、すき間は不確かさを増しながら補間します。各パッチには、補正の求め方とその確かさを示します。
地表の標高（ラスタ、または高さをもつポリゴン）を与えると3次元で補正します。与えない場合、高さ・ロール・ピッチはそのままです。建物の外形線またはモデルを与えると、計測された壁面が標示と並ぶ第二の根拠になります。標示のない区間でも位置を保ち、両者が一致しない所は位置合わせ済みとしません。結果は「補正軌跡の適用」で適用してください。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.2.4 and 4</source>
        <translation>Javanmardi、3.2.4、4</translation>
    </message>
    <message>
        <source>curb</source>
        <translation>縁石</translation>
    </message>
    <message>
        <source>edge</source>
        <translation>辺</translation>
    </message>
    <message>
        <source>border</source>
        <translation>境界</translation>
    </message>
    <message>
        <source>guard rail</source>
        <translation>ガードレール</translation>
    </message>
    <message>
        <source>breakline</source>
        <translation>ブレークライン</translation>
    </message>
    <message>
        <source>Finds kerbs, lowered kerbs, road borders without kerb, guard rails and walls along the drive of a corrected mobile survey, as lines with heights, standard deviations and the share of their length that was measured.
Kerbs are steps between two smooth sides. Each half metre a profile across the edge gives its foot, top and face; passes through the same place are fitted apart and combined by their sigma. Where neither side is seen, as behind parked cars, a line ends: “gap” tells how far the next part of its chain is away, nothing is drawn in between.
A kerb whose face is not seen, and rails that may be the sides of vehicles, are doubtful, with the reason. Points and trajectory must be corrected ones: lines are as wrong as the survey is.
Objects of “Objects from images” and walls of “Walls from a mobile survey” can be put into one GeoPackage with the edges.</source>
        <translation>補正済みのMMS計測の走行に沿って、縁石、切下げ縁石、縁石のない道路境界、ガードレール、壁を、高さ・標準偏差・計測された長さの割合をもつ線として求めます。
縁石は、2つの滑らかな面の間の段差です。0.5 mごとの横断プロファイルから、縁石の下端・上端・前面を求めます。同じ場所の走行パスは別々に当てはめ、σにより統合します。駐車車両の後ろなど、両側とも見えないところで線は終わります。「gap」は連なりの次の部分までの距離を示し、その間には何も描きません。
前面が見えない縁石や、車両の側面かもしれないガードレールは、理由を付けて疑わしいものとします。点と軌跡は補正済みのものとしてください。線の誤差は計測データの誤差と同じになります。
「画像からの地物」の地物と「MMS計測の壁面」の壁面は、道路端と同じ1つのGeoPackageに入れることができます。</translation>
    </message>
    <message>
        <source>paint</source>
        <translation>標示</translation>
    </message>
    <message>
        <source>reflectance</source>
        <translation>反射率</translation>
    </message>
    <message>
        <source>threshold</source>
        <translation>しきい値</translation>
    </message>
    <message>
        <source>Takes the points on road markings out of a mobile laser survey by their intensity.
Intensity falls with range and incidence: asphalt's is fitted as a curve over range for each scanner, and all intensities are divided by it. Points brighter than the ground round them are marking points, if they form strokes; kerbs, feet of walls and wide bright surfaces are left out.
Ground is taken by class 2 where at least 1 % of the points have it, otherwise found by the cloth filter. The survey is worked on along the path: passes through the same place are not mixed, and what was measured while the vehicle stood for more than a second is left out. The files may be larger than memory.</source>
        <translation>MMS計測のレーザ点群から、反射強度により路面標示上の点を抽出します。
反射強度は斜距離と入射角により低下します。スキャナごとに、アスファルトの反射強度を斜距離の曲線に当てはめ、すべての反射強度をその値で割ります。周囲の地表より明るい点が線状をなすとき、路面標示点とします。縁石、壁の下端、広い明るい面は除きます。
地表は、点の1 %以上がクラス2であればクラス2とし、それ以外は布シミュレーションフィルタで求めます。処理は経路に沿って行います。同じ場所の走行パスどうしは混ぜず、1秒を超える停車中に計測されたものは除きます。ファイルはメモリより大きくてもかまいません。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.2.3</source>
        <translation>Javanmardi、3.2.3</translation>
    </message>
    <message>
        <source>zebra</source>
        <translation>ゼブラ</translation>
    </message>
    <message>
        <source>crossing</source>
        <translation>横断</translation>
    </message>
    <message>
        <source>adaptive threshold</source>
        <translation>適応的閾値処理</translation>
    </message>
    <message>
        <source>Finds painted road markings, white, yellow and blue, in an orthophoto: a mask on the orthophoto's pixels and polygons whose outlines are finer than the pixels.
After a level adjustment, pixels are kept that are brighter by the contrast than the Gaussian mean of the block round them (in shade in proportion less), and stand out on both sides. A model trained on made-up streets then tells how likely each piece is paint, by its shape and contrast, the ground round it and its company: that is its confidence.
Any orthophoto of 0.5 m or finer will do, in grey or in red, green and blue, 8 or 16 bit, of any size. Give roads where you have them: bright lines on roofs, plots and paving are then left out. Give building outlines, or the mask of what buildings hide, where they lean in the image.</source>
        <translation>オルソ画像から白・黄・青の路面標示を抽出する。結果はオルソ画像の画素上のマスクと、画素より細かい輪郭のポリゴンである。
レベル補正の後、周囲のブロックのガウス平均よりコントラスト以上に明るく（日陰では比例して小さく）、両側で際立つ画素を残す。次に、架空の街路で学習したモデルが、形とコントラスト、周囲の地面、近くの標示から、それぞれが標示である確からしさを求める。これが信頼度である。
0.5 m以下の画素のオルソ画像なら、濃淡でもRGBでも、8ビットでも16ビットでも、どんな大きさでもよい。道路があれば与える。屋根・敷地・舗装の明るい線が除かれる。画像で建物が傾いて写るときは、建物の外形か、建物が隠す範囲のマスクを与える。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.2.2 and 4.1</source>
        <translation>Javanmardi、3.2.2、4.1</translation>
    </message>
    <message>
        <source>junction</source>
        <translation>交差部</translation>
    </message>
    <message>
        <source>intersection</source>
        <translation>交差点</translation>
    </message>
    <message>
        <source>corner cut-off</source>
        <translation>隅切り</translation>
    </message>
    <message>
        <source>road edge</source>
        <translation>道路縁</translation>
    </message>
    <message>
        <source>Makes road models as PLATEAU defines them. LOD1 comes from edges or surfaces of roads alone: cut at junctions, bridges and tunnels, with middle lines, findings and a CityGML file. LOD2 and LOD3.0 to 3.3 come from the edges that a survey measured: carriageways, junctions cut at the extension of stop lines (from 3.1; else at corners), lanes (from 3.1), sidewalks, islands; with steps from 15 cm (3.2) or 2 cm (3.3) as faces. What the survey did not see is never made up: it is drawn on over short gaps and told, left undivided where only the given roads show it, and each area says its source.
Surfaces are dissolved and cut anew; lines along both edges are closed to surfaces, where two ends lie across a road from each other. A junction is where three or more roads meet. Its arms are cut as the working procedure says: at the ends of the corner cut-offs, else at the corners; with four or more arms from contact to contact, with three across the road at the outermost contact. Junctions that overlap are one.
Surfaces share their edges to the bit. Heights are 0, as the specification asks of LOD1. What is doubtful is a finding with its place: arms without a corner, edges that do not close, surfaces that cross themselves.</source>
        <translation>PLATEAU の定義に従って道路モデルを作ります。LOD1 は道路の縁または面だけから作り、交差部、橋、トンネルで区切り、中心線、指摘事項、CityGML ファイルを付けます。LOD2 と LOD3.0〜3.3 は計測した縁から作ります。車道部、停止線の延長で区切った交差部（3.1 以上、それ以外は隅角部）、車線（3.1 以上）、歩道部、島を分け、15 cm（3.2）または 2 cm（3.3）以上の段差を面として持ちます。計測で見えなかったものは作りません。短い欠けは延長してその旨を示し、与えられた道路だけが示す所は分割せず、各区域に出典を書きます。
面は一度まとめてから区切り直します。両側の縁の線は、端どうしが道路を挟んで向かい合う所で閉じて面にします。交差部は三本以上の道路が出会う所です。枝は作業手順書のとおり、隅切りの端、なければ隅角部で区切ります。四枝以上では接点から接点へ、三枝では最も外側の接点で道路を横切って区切ります。重なる交差部は一つにします。
面は縁を完全に共有します。LOD1 の高さは仕様書のとおり 0 です。疑わしいものは位置とともに指摘事項になります（隅角部のない枝、閉じない縁、自己交差する面など）。</translation>
    </message>
    <message>
        <source>Project PLATEAU, standard product specification of 3D city models 5.0, 4.3, and its working procedure, annex D</source>
        <translation>Project PLATEAU 3D都市モデル標準製品仕様書 5.0 4.3、および標準作業手順書 附属書D</translation>
    </message>
    <message>
        <source>LOD3</source>
        <translation>LOD3</translation>
    </message>
    <message>
        <source>pole</source>
        <translation>柱</translation>
    </message>
    <message>
        <source>tree</source>
        <translation>樹木</translation>
    </message>
    <message>
        <source>street furniture</source>
        <translation>道路付属物</translation>
    </message>
    <message>
        <source>Goes from a corrected mobile survey and reference markings to the road as a model, in one run: kerbs, lanes, and of them carriageways, junctions, sidewalks and islands with their steps; and what stands beside the road: poles, lamp posts, signals, signs and trees. All as layers and as CityGML of PLATEAU; the lanes with what stands beside them as Lanelet2 and OpenDRIVE files, too.
Several drives are given as one: their points together, their trajectories one after another in one file. What was not seen is a finding with its place, never made up. Where the edges bound no carriageway, the road model is empty and a warning says why; the rest is kept.</source>
        <translation>補正済みのMMS計測と基準の路面標示から、道路のモデルまでを一度に作ります。縁石、車線、それらから車道部、交差部、歩道部、島と段差、さらに道路脇の柱、街路灯、信号機、標識、樹木です。すべてレイヤと PLATEAU の CityGML になり、車線は道路脇のものとともに Lanelet2 と OpenDRIVE のファイルにもなります。
複数の走行は一つにまとめて与えます（点群は一緒に、軌跡は一つのファイルに続けて）。見えなかったものは位置とともに指摘事項になり、作り出すことはありません。縁が車道を囲まない場合、道路モデルは空になり、その理由を警告で示します。ほかの結果は残ります。</translation>
    </message>
    <message>
        <source>Javanmardi, 6.2; Project PLATEAU, standard product specification 5.0, 4.3 and 4.14</source>
        <translation>Javanmardi, 6.2; Project PLATEAU 3D都市モデル標準製品仕様書 5.0, 4.3 および 4.14</translation>
    </message>
    <message>
        <source>roof</source>
        <translation>屋根</translation>
    </message>
    <message>
        <source>polygon</source>
        <translation>ポリゴン</translation>
    </message>
    <message>
        <source>alpha shape</source>
        <translation>アルファシェイプ</translation>
    </message>
    <message>
        <source>Hough</source>
        <translation>ハフ変換</translation>
    </message>
    <message>
        <source>Draws the polygon of each roof from its points.
The method “partition” divides each outline among its roofs along straight lines where roofs meet: no gaps, no slivers, common edges. The method “points” first draws the building's outer limit from its points, for outlines that are wrong in shape, then divides it likewise. The method “paper” outlines each roof on its own: radius outlier removal, alpha shape, Hough lines over the ordered boundary points, and the polygon from these lines, at the height of the roof's highest point; it leaves the outline aside and needs roofs of simple shape. A building without a roof then has no polygon; the other methods give it a plain block.</source>
        <translation>各屋根のポリゴンを点から描きます。
方法「partition」は、屋根どうしが接する直線に沿って、各外周線を屋根に分割します。すき間や細片がなく、辺を共有します。方法「points」は、形状が誤っている外周線のために、まず点から建物の外周を描き、次に同様に分割します。方法「paper」は、各屋根の輪郭を個別に描きます。半径外れ値除去、アルファシェイプ、順序付けた境界点のハフ変換による線、これらの線からのポリゴンの順に求め、屋根の最高点の高さに置きます。外周線は用いず、単純な形状の屋根に限られます。この方法では屋根のない建物にポリゴンはありませんが、ほかの方法では単純ブロックとします。</translation>
    </message>
    <message>
        <source>job</source>
        <translation>作業</translation>
    </message>
    <message>
        <source>batch</source>
        <translation>バッチ処理</translation>
    </message>
    <message>
        <source>chain</source>
        <translation>一連の処理</translation>
    </message>
    <message>
        <source>resume</source>
        <translation>再開</translation>
    </message>
    <message>
        <source>repeat</source>
        <translation>繰り返し</translation>
    </message>
    <message>
        <source>dock</source>
        <translation>パネル</translation>
    </message>
    <message>
        <source>Runs the steps of a job that the dock “UrbanMap” has planned and saved. Steps that are done and whose inputs, settings and results are as they were are left alone, so that an ended run goes on where it stopped. What became of each step is written into the job's file.
To repeat the job on another survey, give its files as lines ROLE=FILE (several with “;” between them), and another folder: the job's file is then written into that folder, and the first one stays as it is.
A step that fails ends the run with its sentence (on the command line with exit code 1).</source>
        <translation>パネル「UrbanMap」で計画して保存した作業の手順を実行します。完了していて、入力・設定・結果が変わっていない手順はそのまま残すので、中断した処理は止まったところから続きます。各手順の結果は作業ファイルに書き込みます。
別の計測に作業を繰り返すには、そのファイルを「役割=ファイル」の行で指定し（複数の場合は「;」で区切る）、別のフォルダを指定します。作業ファイルはそのフォルダに書き込み、元の作業ファイルは変わりません。
手順が失敗すると、理由を示して終了します（コマンドラインでは終了コード1）。</translation>
    </message>
    <message>
        <source>own</source>
        <translation>独自</translation>
    </message>
    <message>
        <source>Getting started</source>
        <translation>はじめに</translation>
    </message>
    <message>
        <source>sample</source>
        <translation>サンプル</translation>
    </message>
    <message>
        <source>example</source>
        <translation>例</translation>
    </message>
    <message>
        <source>demo</source>
        <translation>デモ</translation>
    </message>
    <message>
        <source>test data</source>
        <translation>試験データ</translation>
    </message>
    <message>
        <source>simulation</source>
        <translation>シミュレーション</translation>
    </message>
    <message>
        <source>synthetic</source>
        <translation>合成データ</translation>
    </message>
    <message>
        <source>tutorial</source>
        <translation>チュートリアル</translation>
    </message>
    <message>
        <source>Makes a city block that does not exist, with all the data that UrbanMap works on and the truth to check the results against: aerial frames, airborne laser points, official outlines, two mobile surveys that are about a metre off, line scans, GNSS observations.
Begin here without data of your own: every algorithm can be tried on the files in the folder, which are in UrbanMap's own formats. A README.txt in the folder says what is where. The default city takes about a minute and 60 MB.
The same seed, size and scene give the same files.</source>
        <translation>実在しない街区と、UrbanMapが扱うすべてのデータ、結果を照合するための真値を作成します。空中写真、航空レーザ点群、公的な建物外周線、約1 mずれた2回のMMS計測、ラインスキャン、GNSS観測値です。
自分のデータがない場合はここから始めてください。フォルダ内のファイルはUrbanMap独自の形式で、すべてのアルゴリズムを試せます。フォルダ内のREADME.txtに、どこに何があるかを示します。既定の都市は約1分、60 MBです。
同じシード、大きさ、シーンからは同じファイルができます。</translation>
    </message>
    <message>
        <source>Satellite visibility</source>
        <translation>衛星可視性</translation>
    </message>
    <message>
        <source>line of sight</source>
        <translation>見通し線</translation>
    </message>
    <message>
        <source>LOS</source>
        <translation>LOS</translation>
    </message>
    <message>
        <source>PDOP</source>
        <translation>PDOP</translation>
    </message>
    <message>
        <source>sky</source>
        <translation>上空視界</translation>
    </message>
    <message>
        <source>planning</source>
        <translation>観測計画</translation>
    </message>
    <message>
        <source>Counts the navigation satellites in line of sight among building models: along a trajectory, or over an area at a given time.
Fewer than four satellites of one system do not give a position; with each further system one more is needed for its clock (QZSS keeps that of GPS). The PDOP tells how much larger the error of a position is than that of a range; it is empty where the satellites in line of sight fix no position.
Walls hide satellites; trees, vehicles and bridges do not. Where walls of the models stand a metre off, satellites near their edges are counted wrongly.</source>
        <translation>建物モデルの間で見通し内にある測位衛星の数を、軌跡に沿って、または指定時刻の範囲全体で数えます。
1つの衛星系で4衛星未満では位置が求まりません。衛星系が1つ増えるごとに、その時計のためにもう1衛星が必要です（QZSSはGPSと同じ時計です）。PDOPは、位置の誤差が距離の誤差の何倍かを示します。見通し内の衛星では位置が決まらない場合は空です。
壁面は衛星を隠しますが、樹木・車両・橋は考慮しません。モデルの壁面が1 mずれていると、その辺の近くの衛星の数は誤ります。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.3 (figure 3-20)</source>
        <translation>Javanmardi、3.3 （図3-20）</translation>
    </message>
    <message>
        <source>Segment buildings</source>
        <translation>建物の抽出</translation>
    </message>
    <message>
        <source>segmentation</source>
        <translation>セグメンテーション</translation>
    </message>
    <message>
        <source>Takes the laser points of each building out of a point cloud, with the help of rough outlines.
Each outline is first moved to where the points show its building, then expanded, and takes the points inside. Where expanded outlines overlap, a point goes to the building whose own surface is nearest to it. Points of class 6 are used where the cloud is classified; elsewhere what stands high above the ground.
The outlines in the result carry what was found: points, density, ground height, displacement and its standard deviation. A building without points keeps its row and says so, and so does one that is dated after the flight or ended before it, where the points have full GPS times and the outlines their dates.</source>
        <translation>概略の外周線を用いて、点群から建物ごとのレーザ点を取り出します。
各外周線を、まず点が建物を示す位置へ移動し、次に拡張して、内側の点を取り出します。拡張した外周線が重なるところでは、点は自身の面が最も近い建物に属します。点群が分類済みの場合はクラス6の点を、それ以外では地表から高いものを用います。
結果の外周線は、求めたもの（点数、密度、地盤の標高、変位とその標準偏差）をもちます。点のない建物も行を保ち、その旨を示します。点群が完全な GPS 時刻を、外周線が日付をもつときは、撮影より後の日付の建物と、撮影より前に消滅した建物も、その旨を示します。</translation>
    </message>
    <message>
        <source>Javanmardi, 5.3.1</source>
        <translation>Javanmardi、5.3.1</translation>
    </message>
    <message>
        <source>Segment roofs</source>
        <translation>屋根の分割</translation>
    </message>
    <message>
        <source>histogram</source>
        <translation>ヒストグラム</translation>
    </message>
    <message>
        <source>Segments the roofs of each building: planes, level and sloped, grown on its points; or level roofs by the histogram of its points' heights.
The histogram has overlapping bins. Each maximum with more points than the minimum roof area holds is a roof; a parapet's maximum is joined with its roof's. Beyond the paper, one maximum that is two roofs apart in plan becomes two, small roofs that stand out are kept, and sloped roofs become a few level ones, as finely as the height error asks.</source>
        <translation>各建物の屋根を分割します。点から成長させた水平・傾斜の平面、または点の高さのヒストグラムによる陸屋根とします。
ヒストグラムの階級は互いに重なります。最小屋根面積に相当する数より点の多い極大のそれぞれを屋根とし、パラペットの極大はその屋根のものと統合します。論文に加えて、平面上で離れた2つの屋根からなる1つの極大は2つに分け、突出する小さな屋根を残し、傾斜屋根は高さの誤差の要求に応じた細かさで、いくつかの陸屋根とします。</translation>
    </message>
    <message>
        <source>Javanmardi, 5.3.2</source>
        <translation>Javanmardi、5.3.2</translation>
    </message>
    <message>
        <source>lamp post</source>
        <translation>街灯</translation>
    </message>
    <message>
        <source>street light</source>
        <translation>街路灯</translation>
    </message>
    <message>
        <source>traffic light</source>
        <translation>交通信号機</translation>
    </message>
    <message>
        <source>traffic sign</source>
        <translation>道路標識</translation>
    </message>
    <message>
        <source>bollard</source>
        <translation>車止め</translation>
    </message>
    <message>
        <source>cabinet</source>
        <translation>制御箱</translation>
    </message>
    <message>
        <source>Finds poles, lamp posts, signals, signs, trees, bollards and boxes such as cabinets along the drive of a corrected mobile survey, as points at their feet with height, diameter, direction and standard deviation.
Things that stay narrow in plan over height are stems. The axis of a stem is adjusted to the sides of it that were seen, as each line of sight sees its middle across and its face before the axis. The sizes and the place of what hangs on the stem, beside those that standards of Japan, Germany and the United States give to signals, signs and lamps, tell the kind and how likely it is; leaves on all sides make a tree. What a sign says is not read. Bollards (0.5 to 1.5 m high) and boxes (0.7 to 2 m high, “other upright”) stand free beside the road.
Stems of few points, with a hidden foot, or that may be a part of a wall are doubtful, with the reason. Points and trajectory must be corrected ones: objects are as wrong as the survey is.</source>
        <translation>補正済みの MMS の走行に沿って、柱、街灯、信号、標識、樹木、車止め、制御箱などの箱状の物を探し、根元の点として高さ・直径・向き・標準偏差とともに出します。
高さ方向に平面上で細いままの物を幹（柱）とします。幹の軸は、見えた面に合わせて調整します（各視線は、横方向では軸の中央を、奥行きでは軸の手前の面を見ます）。幹に付いている物の寸法と位置を、日本・ドイツ・米国の基準が定める信号・標識・灯具のものと比べて、種類とその確からしさを求めます。四方に葉があれば樹木です。標識の内容は読みません。車止め（高さ 0.5～1.5 m）と箱状の物（高さ 0.7～2 m、「その他の立体物」）は道路脇に単独で立つ物です。
点の少ない幹、根元が隠れた幹、壁の一部かもしれない幹は、理由とともに疑わしいとします。点群と軌跡は補正済みでなければなりません：対象物の誤差は測量の誤差と同じだけあります。</translation>
    </message>
    <message>
        <source>DSM</source>
        <translation>DSM</translation>
    </message>
    <message>
        <source>DTM</source>
        <translation>DTM</translation>
    </message>
    <message>
        <source>surface</source>
        <translation>表層</translation>
    </message>
    <message>
        <source>terrain</source>
        <translation>地形</translation>
    </message>
    <message>
        <source>Delaunay</source>
        <translation>ドロネー</translation>
    </message>
    <message>
        <source>Makes the surface (DSM) and the ground elevation of a laser point cloud as rasters.
The surface is the 2.5D Delaunay triangulation of the highest point of each cell. The ground is the triangulation of the ground points, which also spans buildings: it has no gap under them. Ground points are those classified so (classes 2, 8, 10, 11; not water) or, where the cloud is unclassified, those that a cloth drawn up from below touches.
Noise (classes 7 and 18), withheld points and points alone in space are left out. The files may be larger than memory. Cells without a height hold -9999.</source>
        <translation>レーザ点群の表層（DSM）と地表の標高をラスタとして作成します。
表層は、各セルの最高点の2.5Dドロネー三角網です。地表は地表点の三角網で、建物の下もすき間なくつなぎます。地表点は、そのように分類された点（クラス2、8、10、11。水面は除く）、または点群が未分類の場合は、下から当てた布が触れる点です。
ノイズ（クラス7と18）、withheldの点、孤立点は除きます。ファイルはメモリより大きくてもかまいません。高さのないセルは -9999 です。</translation>
    </message>
    <message>
        <source>Javanmardi, 3.2.1.1 and 4.1; cloth filter: Zhang et al. 2016</source>
        <translation>Javanmardi、3.2.1.1、4.1。布シミュレーションフィルタ：Zhangほか 2016</translation>
    </message>
    <message>
        <source>Propose tie points</source>
        <translation>タイポイントの提案</translation>
    </message>
    <message>
        <source>corners</source>
        <translation>角</translation>
    </message>
    <message>
        <source>buildings</source>
        <translation>建物</translation>
    </message>
    <message>
        <source>rectification</source>
        <translation>補正</translation>
    </message>
    <message>
        <source>Proposes tie points for “Rectify trajectory”: corners of buildings that both the survey and outlines or a surface show.
Where points of the survey stand over each other there are walls; the two walls of each corner are looked for along the building's edges, and meet in the survey's corner. Of several possible places the one is taken that is shifted like the corners measured about the same time. Corners are gathered in sets of two.
Each line of the result runs from the survey to the reference. Look at them before they are used: delete wrong ones, move ends, add others. They are as good as the reference: give its accuracy as “Sigma of tie points” to the rectification. Edges of a surface are those of the roofs.</source>
        <translation>「軌跡の補正」のためのタイポイントとして、計測データと、外周線または表層の両方に現れる建物の角を提案します。
計測データの点が上下に重なるところに壁面があります。各角の2つの壁面を建物の辺に沿って探し、その交点を計測データの角とします。候補が複数ある場合は、ほぼ同じ時刻に計測された角と同じようにずれているものを採用します。角は2つずつの組にまとめます。
結果の各線は、計測データから基準へ向かいます。使う前に確認し、誤った線の削除、端点の移動、線の追加を行ってください。その精度は基準の精度によります。補正では、基準の精度を「タイポイントのσ」に指定してください。表層の辺は屋根の縁です。</translation>
    </message>
    <message>
        <source>Zhao and Shibasaki, 3.2, where tie points are assigned by hand</source>
        <translation>Zhao・Shibasaki、3.2（論文ではタイポイントを手で指定）</translation>
    </message>
    <message>
        <source>tile</source>
        <translation>タイル</translation>
    </message>
    <message>
        <source>grid</source>
        <translation>グリッド</translation>
    </message>
    <message>
        <source>large area</source>
        <translation>広域</translation>
    </message>
    <message>
        <source>overnight</source>
        <translation>夜間実行</translation>
    </message>
    <message>
        <source>scale</source>
        <translation>大規模</translation>
    </message>
    <message>
        <source>Runs another algorithm over an area of any size, tile by tile: each tile reads its part of the inputs with a buffer around it, and keeps what is its own of the results, so that a building on an edge is there once.
Each tile is whole or not there. Run again with the same folder, settings and inputs, it goes on where it was ended; tiles that failed, or whose inputs changed, are done again. One failed tile does not end the run: all others are done and put together, and then the run ends with an error (on the command line with exit code 1).
The algorithm's parameters are given as lines NAME=VALUE, on the command line also by themselves. Point clouds, rasters and layers among them are cut; everything else is the same for all tiles. Layers and rasters are put together in the folder “merged”, point clouds stay by tile.</source>
        <translation>任意の広さの範囲に対し、ほかのアルゴリズムをタイルごとに実行します。各タイルは周囲のバッファを含めて入力を読み、結果のうち自分のタイルに属するものだけを残すため、境界上の建物も一度だけ現れます。
各タイルの結果は、完全にあるか、まったくないかのどちらかです。同じフォルダ、設定、入力で再度実行すると、中断したところから続けます。失敗したタイルと入力が変わったタイルは処理し直します。1つのタイルの失敗では全体は終わりません。ほかのすべてのタイルを処理して統合した後、エラーとして終了します（コマンドラインでは終了コード1）。
アルゴリズムのパラメータは、NAME=VALUEの行で与えます（コマンドラインでは直接指定することもできます）。点群、ラスタ、レイヤは切り出し、ほかはすべてのタイルで共通です。レイヤとラスタはフォルダ「merged」に統合し、点群はタイルごとに残します。</translation>
    </message>
    <message>
        <source>city model</source>
        <translation>都市モデル</translation>
    </message>
    <message>
        <source>Holds an old city model against a new point cloud: which buildings are the same, new, gone, raised, lowered, rebuilt, extended, reduced, or were not seen.
How far the two epochs lie from each other as a whole is found from all roofs and counts as no change. A building is compared by roof and ground points, so that crowns over it and lorries beside it do not count. What changed and what is new is modelled anew from the points; all others keep their geometry and attributes. A building that too few points show is unseen, never the same and never gone.</source>
        <translation>既存の都市モデルと新しい点群を比べ、各建物を変化なし、新築、滅失、増階（高くなった）、減階（低くなった）、建て替え、増築、一部除却、未観測に分けます。
両時期の全体のずれはすべての屋根から求め、変化とは数えません。建物は屋根と地面の点だけで比べるため、上を覆う樹冠や脇のトラックは影響しません。変化した建物と新築の建物は点群から改めてモデル化し、そのほかは形状と属性を保ちます。点が足りない建物は未観測とし、変化なしとも滅失ともしません。</translation>
    </message>
    <message>
        <source>Zhao and Shibasaki</source>
        <translation>Zhao・柴崎</translation>
    </message>
    <message>
        <source>Makes lanes of line work and drives: bounds shared with the lanes beside, centre lines, width, direction, successors, neighbours, stop lines and crosswalks; as layers, as Lanelet2 file with the tags that Autoware expects, and as OpenDRIVE file.
Lines side by side are a road section. A lane is made between two lines at a lane's width, where a drive, an arrow or a stop line shows its direction, or a lane across a dashed line or across a yellow or double centre line does. Nothing else becomes a lane: strips without evidence, open ends, bounds that were not seen and ways that were driven outside all lanes are findings with a place.
Through junctions a virtual lane is made where a drive shows it, and for movements that arrows, ends of lanes and the rule of the road allow; its evidence tells which. Traffic keeps to the side that the drives show, unless it is given. Trajectories must be corrected ones: an error of a metre puts a drive into the wrong lane.</source>
        <translation>線と走行から車線を作成します。隣の車線と共有する境界、中心線、幅、方向、後続車線、隣接車線、停止線、横断歩道を求め、レイヤ、Autowareが必要とするタグをもつLanelet2ファイル、OpenDRIVEファイルとして出力します。
並んだ線は道路区間となります。車線の幅で並ぶ2本の線の間で、走行・矢印・停止線が方向を示すところ、または破線を隔てた車線、黄色もしくは二重の中央線を隔てた車線が方向を示すところに車線を作成します。それ以外は車線となりません。根拠のない帯、開いた端、見えなかった境界、どの車線にも含まれない走行は、位置を示す指摘事項となります。
交差点内では、走行が示すところと、矢印・車線の終端・通行の規則が許す動きに仮想の車線を作成し、その根拠を記します。通行側は、指定がなければ走行が示す側とします。軌跡は補正済みのものとしてください。1 mの誤差があると、走行が別の車線に入ります。</translation>
    </message>
    <message>
        <source>mobile mapping</source>
        <translation>MMS計測</translation>
    </message>
    <message>
        <source>plane</source>
        <translation>平面</translation>
    </message>
    <message>
        <source>contour</source>
        <translation>輪郭</translation>
    </message>
    <message>
        <source>Finds the walls of buildings in a mobile survey that has been put on the map.
Points near the buildings' outlines and below a height above ground are separated into walls and the rest by their normals, freed of outliers and cut into planes. The alpha shape of each plane's points is the contour of a wall; holes in it are places where nothing was measured, such as windows, passages and shadows.
Each wall says how well its points fit, how well its place is known, how much of it was seen and how much may be hidden behind trees, vehicles and the like. The accuracy is that of the wall in the survey; the place of the survey itself is not in it.</source>
        <translation>地図に位置を合わせたMMS計測から、建物の壁面を求めます。
建物外周線の近くで、地表からの指定の高さより下にある点を、法線により壁面とそれ以外に分け、外れ値を除き、平面に分割します。各平面の点のアルファシェイプが壁面の輪郭となります。その穴は、窓・通路・影など、何も計測されなかった場所です。
各壁面には、点の適合度、位置の確かさ、計測された割合、樹木や車両などに隠れている可能性のある割合を示します。精度は計測データ内での壁面の精度であり、計測データ自体の位置の精度は含みません。</translation>
    </message>
    <message>
        <source>Acceptance: edges of buildings to be surveyed</source>
        <translation>精度管理：点検測量する建物の辺</translation>
    </message>
    <message>
        <source>Component</source>
        <translation>成分</translation>
    </message>
    <message>
        <source>mean (m)</source>
        <translation>平均 (m)</translation>
    </message>
    <message>
        <source>RMSE (m)</source>
        <translation>RMSE (m)</translation>
    </message>
    <message>
        <source>standard deviation (m)</source>
        <translation>標準偏差 (m)</translation>
    </message>
    <message>
        <source>maximum (m)</source>
        <translation>最大 (m)</translation>
    </message>
    <message>
        <source>limit (m)</source>
        <translation>制限値 (m)</translation>
    </message>
    <message>
        <source>upper bound, 95 % (m)</source>
        <translation>上限 95 % (m)</translation>
    </message>
    <message>
        <source>outcome</source>
        <translation>判定</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>検査単位</translation>
    </message>
    <message>
        <source>edges drawn</source>
        <translation>抽出した辺の数</translation>
    </message>
    <message>
        <source>edges there are</source>
        <translation>全辺数</translation>
    </message>
    <message>
        <source>edges needed</source>
        <translation>必要な辺の数</translation>
    </message>
    <message>
        <source>easting (m)</source>
        <translation>座標 東 (m)</translation>
    </message>
    <message>
        <source>northing (m)</source>
        <translation>座標 北 (m)</translation>
    </message>
    <message>
        <source>point</source>
        <translation>点名</translation>
    </message>
    <message>
        <source>unit</source>
        <translation>検査単位</translation>
    </message>
    <message>
        <source>measured easting (m)</source>
        <translation>測定 東 (m)</translation>
    </message>
    <message>
        <source>measured northing (m)</source>
        <translation>測定 北 (m)</translation>
    </message>
    <message>
        <source>measured z (m)</source>
        <translation>測定 z (m)</translation>
    </message>
    <message>
        <source>Nothing was checked: {count} edges were drawn. Survey both ends of each, fill x, y, z into the table of edges and give that as check points.</source>
        <translation>まだ検証していません：{count}辺を抽出しました。各辺の両端を点検測量し、x、y、zを辺の表に記入して、検証点として指定してください。</translation>
    </message>
    <message>
        <source>map level {level}</source>
        <translation>地図情報レベル{level}</translation>
    </message>
    <message>
        <source>the given limits</source>
        <translation>指定した制限値</translation>
    </message>
    <message>
        <source>Accepted for {name}: {count} check points keep every limit. They are too few, or the figure too close, to show it with a confidence of 95 %.</source>
        <translation>合格（{name}）：検証点 {count} 点がすべての制限値を満たします。ただし、点数が少ないか値が制限値に近いため、95 %の信頼度では示せません。</translation>
    </message>
    <message>
        <source>Errors in plan</source>
        <translation>水平位置の較差</translation>
    </message>
    <message>
        <source>Errors in height</source>
        <translation>標高の較差</translation>
    </message>
    <message>
        <source>east (m)</source>
        <translation>東 (m)</translation>
    </message>
    <message>
        <source>north (m)</source>
        <translation>北 (m)</translation>
    </message>
    <message>
        <source>up (m)</source>
        <translation>標高 (m)</translation>
    </message>
    <message>
        <source>plan (m)</source>
        <translation>水平 (m)</translation>
    </message>
    <message>
        <source>Nothing was judged, as no limit was given: the figures of {count} check points are below.</source>
        <translation>制限値の指定がないため判定していません。検証点 {count} 点の値は以下のとおりです。</translation>
    </message>
    <message>
        <source>Not accepted for {name}: {component} {rmse:.3f} m, limit {limit:.3f} m{unit}.</source>
        <translation>不合格（{name}）：{component}の標準偏差 {rmse:.3f} m、制限値 {limit:.3f} m{unit}。</translation>
    </message>
    <message>
        <source>Not judged for {name}: {component} has {count} check points{unit}, and {needed} are needed.</source>
        <translation>未判定（{name}）：{component}の検証点が {count} 点{unit}で、{needed} 点必要です。</translation>
    </message>
    <message>
        <source>Accepted for {name}: {count} check points keep every limit, also with a confidence of 95 %.</source>
        <translation>合格（{name}）：検証点 {count} 点が、95 %の信頼度でもすべての制限値を満たします。</translation>
    </message>
    <message>
        <source>Criteria of map level {level}</source>
        <translation>地図情報レベル{level}の判定</translation>
    </message>
    <message>
        <source>Criteria</source>
        <translation>判定</translation>
    </message>
    <message>
        <source>edges with both ends measured</source>
        <translation>両端を計測した辺の数</translation>
    </message>
    <message>
        <source>Ends of the edges, with room for what is measured</source>
        <translation>辺の端点（測定値の記入欄）</translation>
    </message>
    <message>
        <source>Left out, as the product was adjusted to them: {count} points.</source>
        <translation>調整に用いたため除外した点：{count} 点。</translation>
    </message>
    <message>
        <source>east</source>
        <translation>東</translation>
    </message>
    <message>
        <source>north</source>
        <translation>北</translation>
    </message>
    <message>
        <source>plan (distance)</source>
        <translation>水平（距離）</translation>
    </message>
    <message>
        <source>Figure</source>
        <translation>項目</translation>
    </message>
    <message>
        <source>Errors in plan, drawn larger than the map; red: above the limit. Arrows that all point one way are an error that the whole product shares.</source>
        <translation>水平位置の較差（地図より拡大）。赤は制限値を超えるもの。矢印がそろって同じ方向を向く場合は、成果全体に共通する誤差です。</translation>
    </message>
    <message>
        <source>Not judged for {name}: {edges} edges with both ends measured{unit}, and {needed} are needed.</source>
        <translation>{name}の判定はできません：両端を計測した辺が{edges}辺{unit}で、{needed}辺必要です。</translation>
    </message>
    <message>
        <source>{name} holds no check point: give points that were measured independently and to which the product was not adjusted.</source>
        <translation>{name}に検証点がありません。独立に測量し、成果の調整に用いていない点を指定してください。</translation>
    </message>
    <message>
        <source>{name} has no field {field}: choose the field that names the units of inspection.</source>
        <translation>{name}にフィールド{field}がありません。検査単位の名前を示すフィールドを選択してください。</translation>
    </message>
    <message>
        <source>{name} has no column {missing}: give control points with a trajectory, the residuals of such a run, or a table with x, y, z (true) and x_product, y_product, z_product.</source>
        <translation>{name}に列{missing}がありません。軌跡とともに検証点を指定するか、その実行の残差、またはx、y、z（真値）とx_product、y_product、z_productの列をもつ表を指定してください。</translation>
    </message>
    <message>
        <source>{name}: the role “{role}” is not known: check points are “check” (検証点), points that the product was adjusted to “adjusted” (調整点).</source>
        <translation>{name}: role列の値「{role}」は未対応です。検証点は「check」（検証点）、調整に用いた点は「adjusted」（調整点）とします。</translation>
    </message>
    <message>
        <source>passed</source>
        <translation>合格</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>不合格</translation>
    </message>
    <message>
        <source>not checked</source>
        <translation>未判定</translation>
    </message>
    <message>
        <source>position in plan</source>
        <translation>水平位置</translation>
    </message>
    <message>
        <source>too few points there</source>
        <translation>点が少ない</translation>
    </message>
    <message>
        <source>nothing lower beside it: another building, a tree, or no points</source>
        <translation>隣に低いところがない（隣の建物、樹木、点なし）</translation>
    </message>
    <message>
        <source>points, but no edge within the window</source>
        <translation>点はあるが範囲内に辺がない</translation>
    </message>
    <message>
        <source>not shown sharply enough for this limit</source>
        <translation>この制限値に対して位置が不明瞭</translation>
    </message>
    <message>
        <source>No building has an edge of {length:g} m with heights: give models, not outlines.</source>
        <translation>高さをもつ {length:g} m 以上の辺のある建物がありません。外周線ではなく建物モデルを指定してください。</translation>
    </message>
    <message>
        <source>Acceptance: edges of buildings against laser points</source>
        <translation>精度管理：建物の辺とレーザ点群の比較</translation>
    </message>
    <message>
        <source>All edges shown by the points</source>
        <translation>点群で確認できた辺の一覧</translation>
    </message>
    <message>
        <source>This is a check of the modelling, not of accuracy: the points are not said to be of another, more accurate survey. What models and points have in common is not seen.</source>
        <translation>これはモデリングの点検であり、精度の点検ではありません。点群が別の、より精度の高い測量であるとは指定されていません。モデルと点群に共通する誤差は現れません。</translation>
    </message>
    <message>
        <source>The points were said to be of another, more accurate survey than the models. Neither their dates nor their names prove that: models that were made from these points would agree with them whatever the points' own errors.</source>
        <translation>点群はモデルとは別の、より精度の高い測量であると指定されました。日付や名称ではそれを証明できません。この点群から作られたモデルは、点群自体の誤差にかかわらず点群と一致します。</translation>
    </message>
    <message>
        <source>Places of edges are found in the points by themselves: the model says only where to look, and how the roof slopes. They show an edge across itself, not along; the standard deviation in plan is put together from edges of different directions, about a mean of 0.</source>
        <translation>辺の位置は点群だけから求めます。モデルは探す場所と屋根の傾きを示すだけです。点群から分かるのは辺に直角な方向の位置だけで、水平位置の標準偏差は方向の異なる辺を合わせて、平均 0 のまわりで求めます。</translation>
    </message>
    <message>
        <source>edges</source>
        <translation>辺数</translation>
    </message>
    <message>
        <source>edges shown by the points</source>
        <translation>点群に現れた辺</translation>
    </message>
    <message>
        <source>all models east (m)</source>
        <translation>全体のずれ 東 (m)</translation>
    </message>
    <message>
        <source>all models north (m)</source>
        <translation>全体のずれ 北 (m)</translation>
    </message>
    <message>
        <source>all models up (m)</source>
        <translation>全体のずれ 上 (m)</translation>
    </message>
    <message>
        <source>outward, mean (m)</source>
        <translation>外向き 平均 (m)</translation>
    </message>
    <message>
        <source>across, maximum (m)</source>
        <translation>辺に直角 最大 (m)</translation>
    </message>
    <message>
        <source>sigma of the points' edges (m)</source>
        <translation>点群の辺の標準偏差 (m)</translation>
    </message>
    <message>
        <source>Edge</source>
        <translation>辺</translation>
    </message>
    <message>
        <source>Building</source>
        <translation>建物</translation>
    </message>
    <message>
        <source>outward (m)</source>
        <translation>外向き (m)</translation>
    </message>
    <message>
        <source>sigma (m)</source>
        <translation>標準偏差 (m)</translation>
    </message>
    <message>
        <source>sigma of the height (m)</source>
        <translation>高さの標準偏差 (m)</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>除外の理由</translation>
    </message>
    <message>
        <source>Accepted for {name}: {count} edges keep every limit, also with a confidence of 95 %.</source>
        <translation>{name}：合格。{count} 辺がすべての制限値を満たし、信頼度 95 % でも満たします。</translation>
    </message>
    <message>
        <source>Not judged for {name}: nearly all edges{unit} run one way, and nothing is known along them.</source>
        <translation>{name}：判定していません。ほとんどの辺{unit}が同じ方向で、その方向の位置が分かりません。</translation>
    </message>
    <message>
        <source>Not judged for {name}: at {absent} edges{unit} there are points, but no edge within reach of the model's. Look at them: what is left out could be the worst.</source>
        <translation>{name}：判定していません。{absent} 辺{unit}では点群があるのに、モデルの辺の近くに辺がありません。確認してください。除外した辺が最も悪い可能性があります。</translation>
    </message>
    <message>
        <source>Not judged for {name}: {component} is shown at {edges} edges{unit}, and {needed} are needed.</source>
        <translation>{name}：判定していません。{component}が分かる辺は {edges} 辺{unit}で、{needed} 辺が必要です。</translation>
    </message>
    <message>
        <source>Each unit needs {needed} edges. Those that the points do not show are left out. Points without an edge near that of the model speak against it: where they are more than a tenth of those that the points cover, nothing is accepted.</source>
        <translation>検査単位ごとに {needed} 辺が必要です。点群に現れない辺は除きます。点群があるのにモデルの近くに辺がない場合はモデルの誤りが疑われ、点群のある辺の 1 割を超えるときは判定しません。</translation>
    </message>
    <message>
        <source>Errors across the edges, outward</source>
        <translation>辺に直角な方向の較差（外向き）</translation>
    </message>
    <message>
        <source>Errors across the edges, drawn larger than the map; red: above the limit. Arrows that all point one way are an error that the whole product shares.</source>
        <translation>辺に直角な方向の較差（地図より拡大）。赤：制限値を超えるもの。矢印がすべて同じ向きなら、成果全体に共通する誤差です。</translation>
    </message>
    <message>
        <source>Nothing was judged, as no limit was given: the figures of {count} edges are below.</source>
        <translation>制限値がないため判定していません。{count} 辺の値を下に示します。</translation>
    </message>
    <message>
        <source>Not judged: the points are not said to be independent of the models. {count} of {all} drawn edges were compared; the figures below are a check of the modelling.</source>
        <translation>判定していません。点群がモデルから独立しているとは指定されていません。抽出した {all} 辺のうち {count} 辺を比べました。下の値はモデリングの点検です。</translation>
    </message>
    <message>
        <source>Accepted for {name}: {count} edges keep every limit. They are too few, or the figure too close, to show it with a confidence of 95 %.</source>
        <translation>{name}：合格。{count} 辺がすべての制限値を満たします。ただし、辺が少ないか値が制限値に近く、信頼度 95 % では示せません。</translation>
    </message>
    <message>
        <source>across the edges</source>
        <translation>辺に直角</translation>
    </message>
    <message>
        <source>plan</source>
        <translation>水平位置</translation>
    </message>
    <message>
        <source>Errors across the edges</source>
        <translation>辺に直角な方向の較差</translation>
    </message>
    <message>
        <source>{path} holds no camera: it must be a JSON object with focal_length_mm and so on.</source>
        <translation>{path} にカメラがありません。focal_length_mmなどをもつJSONオブジェクトとしてください。</translation>
    </message>
    <message>
        <source>principal_point_mm in {path} must be two numbers: x0 and y0 in millimetres.</source>
        <translation>{path} のprincipal_point_mmは、2つの数値（x0とy0、ミリメートル）としてください。</translation>
    </message>
    <message>
        <source>{name} is missing in {path} or is not a number: add it.</source>
        <translation>{path} に {name} がないか、数値ではありません。追加してください。</translation>
    </message>
    <message>
        <source>The distortion in {path} is not of the model "brown": convert it, or resample the frames without distortion.</source>
        <translation>{path} の歪みは "brown" モデルではありません。変換するか、空中写真を歪みのないものに再標本化してください。</translation>
    </message>
    <message>
        <source>The distortion in {path} must name its units: "mm" or "focal".</source>
        <translation>{path} の歪みに単位 "mm" または "focal" を示してください。</translation>
    </message>
    <message>
        <source>The camera's focal length, pixel pitch, width and height must be greater than 0.</source>
        <translation>カメラの焦点距離、画素寸法、幅、高さは0より大きくしてください。</translation>
    </message>
    <message>
        <source>The angles are in degrees, gon or radians and in the order papers or usual, not {unit} and {order}.</source>
        <translation>角度の単位はdegrees、gon、radiansのいずれか、順序はpapersまたはusualとしてください（現在は {unit} と {order}）。</translation>
    </message>
    <message>
        <source>{path} has no column {missing}: an exterior orientation needs {columns}.</source>
        <translation>{path} に列 {missing} がありません。外部標定要素には {columns} が必要です。</translation>
    </message>
    <message>
        <source>{path} lists no image.</source>
        <translation>{path} に画像がありません。</translation>
    </message>
    <message>
        <source>{path} holds a value that is not a number for {names}: correct it.</source>
        <translation>{path} の {names} に数値でない値があります。修正してください。</translation>
    </message>
    <message>
        <source>The angles in {path} look like {guess}: convert them to degrees, or say their unit if you know it.</source>
        <translation>{path} の角度は {guess} と思われます。度に変換するか、単位が分かる場合は指定してください。</translation>
    </message>
    <message>
        <source>Row {row} of {path} names no image or one that came before: each image needs one row.</source>
        <translation>{path} の {row} 行目に画像名がないか、前と同じ名前です。画像ごとに 1 行必要です。</translation>
    </message>
    <message>
        <source>{path}: the rotation matrix of {image} contradicts its omega, phi and kappa: export it again, or say the order and the unit of the angles.</source>
        <translation>{path}：{image} の回転行列が omega、phi、kappa と一致しません。出力し直すか、角の順序と単位を指定してください。</translation>
    </message>
    <message>
        <source>Row {row} of {path} ({name}) must hold numbers in x, y, z, omega, phi, kappa.</source>
        <translation>{path} の {row} 行目（{name}）の x、y、z、omega、phi、kappa は数値でなければなりません。</translation>
    </message>
    <message>
        <source>The frame {twice} is given twice: name each once.</source>
        <translation>空中写真 {twice} が2回指定されています。1回だけ指定してください。</translation>
    </message>
    <message>
        <source> and {count} more</source>
        <translation> ほか {count} 件</translation>
    </message>
    <message>
        <source>Images of the exterior orientation are not in {folder}: {missing}{more}; copy them there, or choose the frames one by one.</source>
        <translation>外部標定要素の画像が {folder} にありません: {missing}{more}。そこにコピーするか、空中写真を1枚ずつ選択してください。</translation>
    </message>
    <message>
        <source>{path} has {width} x {height} pixels but the camera {width_2} x {height_2}: choose the camera file of these frames.</source>
        <translation>{path} は {width} x {height} 画素ですが、カメラは {width_2} x {height_2} です。この写真のカメラファイルを選択してください。</translation>
    </message>
    <message>
        <source>{path} holds {dtype} values: convert it to 8 or 16 bit.</source>
        <translation>{path} の値の型は {dtype} です。8または16ビットに変換してください。</translation>
    </message>
    <message>
        <source>The exterior orientation has no line for {given}: add it, or leave the frame out.</source>
        <translation>外部標定要素に {given} の行がありません。追加するか、その空中写真を除いてください。</translation>
    </message>
    <message>
        <source>{path} cannot be read as an image: check the file.</source>
        <translation>{path} を画像として読み込めません。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{path} is damaged: {error}.</source>
        <translation>{path} は破損しています: {error}。</translation>
    </message>
    <message>
        <source>{image} looks past the surface and ground rasters: choose rasters of its place, and check that heights, CRS and angles fit.</source>
        <translation>{image} の撮影範囲は表層と地表のラスタの外です。その場所のラスタを選択し、高さ、CRS、角度が合っているか確認してください。</translation>
    </message>
    <message>
        <source>{uncovered:.0%} of {image} looks beyond the surface or the ground raster: buildings there are not masked.</source>
        <translation>{image} の {uncovered:.0%} は表層または地表のラスタの外です。そこの建物はマスクされません。</translation>
    </message>
    <message>
        <source>{output} cannot be written ({error}): choose another output.</source>
        <translation>{output} に書き込めません（{error}）。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>{mask} does not cover all of {path}: where it does not, nothing is taken as hidden.</source>
        <translation>{mask} は {path} の全体を覆っていません。覆われていないところでは、遮蔽はないものとします。</translation>
    </message>
    <message>
        <source>{polygons_count} markings were found. </source>
        <translation>{polygons_count} 個の路面標示が見つかりました。 </translation>
    </message>
    <message>
        <source>{unlike} show different things where they overlap: one of them is wrongly oriented, and what it shows lies at wrong places.</source>
        <translation>{unlike} は、重なる所に別の物が写っています。どれかの標定が誤っており、そこに写る物の位置は誤りです。</translation>
    </message>
    <message>
        <source>No two frames share enough markings to be compared: a wrong orientation would not show.</source>
        <translation>比較に十分な路面標示を共有する空中写真の組がありません。標定要素に誤りがあっても現れません。</translation>
    </message>
    <message>
        <source>With pixels of {pixel:.2f} m lane lines are narrower than a pixel: many are missed.</source>
        <translation>{pixel:.2f} mの画素では車線の線が1画素より細く、多くが検出されません。</translation>
    </message>
    <message>
        <source>{alone:.0%} of the ground in the image is seen by one frame only: vehicles stay there, and hide markings.</source>
        <translation>画像内の地表の {alone:.0%} は1枚の写真にしか写っていません。車両が残り、路面標示を隠しています。</translation>
    </message>
    <message>
        <source>No roads were given: edges of flat roofs, kerbs, rims of vehicles, reeds at water and lines of car parks may be among the markings; cut by their confidence, or give roads.</source>
        <translation>道路が指定されていません。陸屋根の縁、縁石、車両の縁、水辺の葦、駐車場の線が路面標示に含まれている可能性があります。信頼度で絞り込むか、道路を指定してください。</translation>
    </message>
    <message>
        <source>{mean:.0%} of the markings hardly stand out from the road: worn paint, shadow edges or paving.</source>
        <translation>路面標示の {mean:.0%} は路面とほとんど区別できません。標示の摩耗、影の縁、または舗装です。</translation>
    </message>
    <message>
        <source>no data (buildings, hidden ground, beyond the frames)</source>
        <translation>データなし（建物、隠れた地表、写真の範囲外）</translation>
    </message>
    <message>
        <source>by one frame</source>
        <translation>写真1枚</translation>
    </message>
    <message>
        <source>by two</source>
        <translation>写真2枚</translation>
    </message>
    <message>
        <source>by three or more</source>
        <translation>写真3枚以上</translation>
    </message>
    <message>
        <source>{first} and {second} lie {east:.2f} m apart on the road markings: markings in their overlap are uncertain by as much. Check the orientation.</source>
        <translation>{first} と {second} は路面標示上で {east:.2f} m ずれています。重複部の路面標示は同じだけ不確かです。標定要素を確認してください。</translation>
    </message>
    <message>
        <source>Markings (green) over the orthophoto. Look for paint without an outline, and outlines on roofs, kerbs and vehicles.</source>
        <translation>オルソ画像上の路面標示（緑）。輪郭のない標示と、屋根・縁石・車両上の輪郭を探してください。</translation>
    </message>
    <message>
        <source>To be looked at first: {doubts_count}.</source>
        <translation>先に確認すべき点：{doubts_count} 件。</translation>
    </message>
    <message>
        <source>Nothing stands out; check some markings against the picture all the same.</source>
        <translation>特に問題は見られません。それでも、いくつかの標示を画像と照合してください。</translation>
    </message>
    <message>
        <source>The part with most markings, enlarged</source>
        <translation>路面標示が最も多い部分の拡大</translation>
    </message>
    <message>
        <source>No marking was found: check the roads, the contrast and whether the image shows any.</source>
        <translation>路面標示が見つかりませんでした。道路、コントラスト、および画像に路面標示が写っているかを確認してください。</translation>
    </message>
    <message>
        <source>Half of the image is so light that paint can hardly be lighter than it: snow, concrete or too much light. Paint on such ground is missed.</source>
        <translation>画像の半分が非常に明るく（積雪、コンクリート、露出過多）、路面標示がそれより明るく写る余地がほとんどありません。そのような場所の標示は抽出漏れになります。</translation>
    </message>
    <message>
        <source>Neighbouring lines lie {spacing:.1f} m apart (median): lanes are 2.5 to 4 m wide. The pixel size may be wrong.</source>
        <translation>隣り合う線の間隔（中央値）が {spacing:.1f} m です。車線の幅は 2.5～4 m です。画素寸法の指定が誤っている可能性があります。</translation>
    </message>
    <message>
        <source>Markings cannot be told in this image: by its confidence only {recall:.0%} of the paint was found. Do not use the result. Check the pixel size, light, noise and focus; or give roads.</source>
        <translation>この画像では標示を判別できない。信頼度によると標示の{recall:.0%}しか抽出できていない。結果を使わないこと。画素の大きさ、光、ノイズ、ピントを確かめるか、道路を与える。</translation>
    </message>
    <message>
        <source>Markings cannot be told in this image: {full:.0%} of it are over-exposed. Do not use the result.</source>
        <translation>この画像では標示を見分けられません。画像の {full:.0%} が露出過多です。結果は使わないでください。</translation>
    </message>
    <message>
        <source>{full:.0%} of the image are over-exposed: paint on light ground is missed there.</source>
        <translation>画像の {full:.0%} が露出過多です。そこでは明るい地面の上の標示が見落とされます。</translation>
    </message>
    <message>
        <source>{empty:.0%} of the image are black without being marked as no data: state the no-data value, so that they do not count as ground.</source>
        <translation>画像の {empty:.0%} が黒いままで、データなしとされていません。地面と見なされないように、データなしの値を設定してください。</translation>
    </message>
    <message>
        <source>The image has no colours: earth, roofs and dry grass cannot be told from roads by their colour, and more of them is taken for paint. Give roads.</source>
        <translation>画像に色がありません。土、屋根、枯れ草を色で道路と区別できず、標示と見なされるものが増えます。道路を指定してください。</translation>
    </message>
    <message>
        <source>By its confidence {precision:.0%} of the found area is paint: look at what is doubtful, raise the minimum confidence, or give roads.</source>
        <translation>信頼度によると、抽出面積の{precision:.0%}が標示である。疑わしいものを確認するか、最小信頼度を上げるか、道路を与える。</translation>
    </message>
    <message>
        <source>By its confidence {recall:.0%} of the paint was found: look for paint without an outline, lower the minimum confidence, or give roads.</source>
        <translation>信頼度によると、標示の{recall:.0%}が抽出された。輪郭のない標示を探すか、最小信頼度を下げるか、道路を与える。</translation>
    </message>
    <message>
        <source>Lines are {width:.2f} m wide (median): lane lines have 0.1 to 0.3 m. The pixel size may be wrong, or the image out of focus.</source>
        <translation>線の幅は {width:.2f} m（中央値）です。車線の線は 0.1～0.3 m です。画素の大きさが誤っているか、ピントが合っていない可能性があります。</translation>
    </message>
    <message>
        <source>Nothing in the image is green: it shows no plants, or infrared as a colour. Then leaves and earth cannot be told from roads by their colour; look for finds in them.</source>
        <translation>画像に緑色の部分がありません。植物が写っていないか、赤外線が色として表示されています。その場合、葉や土を色で道路と区別できません。そこでの検出結果を確認してください。</translation>
    </message>
    <message>
        <source>{pale:.0%} of the image are nearly white: snow, or light roofs and ground. Paint on ground so light is missed.</source>
        <translation>画像の {pale:.0%} がほぼ白色です（積雪、または明るい屋根や地面）。このように明るい地面の上の標示は見落とされます。</translation>
    </message>
    <message>
        <source>{path} has a colour table: convert it to red, green and blue first.</source>
        <translation>{path} はカラーテーブルをもっています。先に赤・緑・青に変換してください。</translation>
    </message>
    <message>
        <source>{path} holds complex numbers, no image: give an orthophoto.</source>
        <translation>{path} は複素数で、画像ではありません。オルソ画像を指定してください。</translation>
    </message>
    <message>
        <source>{path} has no image bands: give an orthophoto in grey or in red, green and blue.</source>
        <translation>{path} に画像のバンドがありません。グレー、または赤・緑・青のオルソ画像を指定してください。</translation>
    </message>
    <message>
        <source>{path} says where it lies in numbers that are not finite: it is damaged; export it again.</source>
        <translation>{path} の位置情報に有限でない数値があります。破損しているため、再度出力してください。</translation>
    </message>
    <message>
        <source>{path} has cells of no size: it is damaged; export it again.</source>
        <translation>{path} のセルの大きさが 0 です。壊れていますので、出力し直してください。</translation>
    </message>
    <message>
        <source>{path} has pixels that are not square: warp it to square pixels first.</source>
        <translation>{path} の画素は正方形ではありません。先に正方形の画素に再標本化してください。</translation>
    </message>
    <message>
        <source>{path} has pixels of {own_pixel:.2f} m, in which road markings cannot be seen: use an orthophoto of {max_pixel} m or finer.</source>
        <translation>{path} の画素は {own_pixel:.2f} mで、路面標示を識別できません。{max_pixel} mまたはそれより細かいオルソ画像を用いてください。</translation>
    </message>
    <message>
        <source>{path} does not reach {path_2}: give a mask of the same place.</source>
        <translation>{path} は {path_2} に重なりません。同じ場所のマスクを指定してください。</translation>
    </message>
    <message>
        <source>{path} has the no-data value {nodata:g} within the image too, as saturated paint has: specks of it ({share:.2f} % of the pixels looked at) are taken as white.</source>
        <translation>{path} では、無効値 {nodata:g} が画像の内側にもあります（白飛びした標示も同じ値になります）。小さなもの（調べた画素の {share:.2f} %）は白として扱います。</translation>
    </message>
    <message>
        <source>{path} cannot be read as a raster: check the file.</source>
        <translation>{path} をラスタとして読み込めません。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>Levels are seven numbers, low, high, middle and the road's texture, warmth, green and brightness, the second above the first: give those, or none.</source>
        <translation>レベルは七つの数です（下限、上限、中央値、道路の粗さ、暖かさ、緑、明るさ。二つ目は一つ目より大きい値）。それらを指定するか、何も指定しないでください。</translation>
    </message>
    <message>
        <source>No control point is in any frame: give points with x, y, z and their places in the images.</source>
        <translation>どの写真にも標定点がありません。x、y、z と画像上の位置のある点を指定してください。</translation>
    </message>
    <message>
        <source>The point {point} lies outside {image}: columns and rows are counted in pixels from the upper left.</source>
        <translation>点 {point} が {image} の外にあります。列と行は左上からの画素数です。</translation>
    </message>
    <message>
        <source>The point {point} lies behind the camera of {image}: check the exterior orientation and the coordinates.</source>
        <translation>点 {point} が {image} のカメラの後ろにあります。外部標定要素と座標を確かめてください。</translation>
    </message>
    <message>
        <source>Points were measured in {image}, which the exterior orientation does not name.</source>
        <translation>点を測った {image} が外部標定要素にありません。</translation>
    </message>
    <message>
        <source>No control point was found in the cloud: give points on open ground within it, or their places in it as x_als, y_als.</source>
        <translation>点群の中に調整点が見つかりません。点群内の開けた地面にある点を与えるか、点群中の位置を x_als、y_als に書いてください。</translation>
    </message>
    <message>
        <source>No point tells the cloud's place in plan (x_als, y_als): only its height is shifted.</source>
        <translation>水平位置を示す点（x_als、y_als）がないため、高さだけを移動します。</translation>
    </message>
    <message>
        <source>No point tells the cloud's height: only its place in plan is shifted.</source>
        <translation>高さを示す点がないため、水平位置だけを移動します。</translation>
    </message>
    <message>
        <source>place in plan</source>
        <translation>水平位置</translation>
    </message>
    <message>
        <source>The control points lie close together: away from them the cloud may be tilted.</source>
        <translation>調整点が一か所に集まっています。離れた場所では点群が傾いている可能性があります。</translation>
    </message>
    <message>
        <source>Points that contradict the others, and were not followed: {names}.</source>
        <translation>ほかと矛盾するため使わなかった点：{names}。</translation>
    </message>
    <message>
        <source>The cloud has no ground around these points: {names}.</source>
        <translation>次の点のまわりに点群の地面がありません: {names}</translation>
    </message>
    <message>
        <source>The shift is no larger than its accuracy: the cloud fits as it is.</source>
        <translation>移動量は精度の範囲内です。点群はそのままで合っています。</translation>
    </message>
    <message>
        <source>wrong</source>
        <translation>矛盾</translation>
    </message>
    <message>
        <source>{count} control points tell the {what}: too few to show a wrong one among them.</source>
        <translation>{what}を示す調整点は {count} 点だけです。誤った点があっても見分けられません。</translation>
    </message>
    <message>
        <source>{name} has no control point with {columns}; x_als, y_als, z_als where the point was found in the cloud.</source>
        <translation>{name} に {columns} のある調整点がありません。点群中で見つけた点には x_als、y_als、z_als も書いてください。</translation>
    </message>
    <message>
        <source>{name}: the point {point} is there twice; keep one row.</source>
        <translation>{name}: 点 {point} が2回あります。1行だけ残してください。</translation>
    </message>
    <message>
        <source>{name}: the point {point} has only one of x_als and y_als; give both or none.</source>
        <translation>{name}: 点 {point} には x_als と y_als の片方しかありません。両方書くか、どちらも空にしてください。</translation>
    </message>
    <message>
        <source>The cloud has no ground around any control point: check the coordinate systems, and that the points lie on open ground within the cloud.</source>
        <translation>どの調整点のまわりにも点群の地面がありません。座標系と、点が点群内の開けた地面にあることを確かめてください。</translation>
    </message>
    <message>
        <source>The cloud lies {before:.3f} m off in height at {count} control points as given and {after:.3f} m after (RMS); in plan {plan_before} and {plan_after}.</source>
        <translation>{count} 点の調整点における点群の高さの誤差は、補正前 {before:.3f} m、補正後 {after:.3f} m（RMS）。水平位置の誤差は補正前 {plan_before}、補正後 {plan_after}。</translation>
    </message>
    <message>
        <source>{value:.3f} m</source>
        <translation>{value:.3f} m</translation>
    </message>
    <message>
        <source>not measured</source>
        <translation>測定なし</translation>
    </message>
    <message>
        <source>Each control point left out in turn lies {held:.3f} m off in height.</source>
        <translation>各調整点を順に除外した場合の高さの誤差は {held:.3f} m です。</translation>
    </message>
    <message>
        <source>Check points lie {height} off in height and {plan} in plan.</source>
        <translation>検証点の誤差は、高さ {height}、水平位置 {plan} です。</translation>
    </message>
    <message>
        <source>{name} has no number for {column} in row {row}: correct or remove it.</source>
        <translation>{name} の {row} 行目の {column} が数値ではありません。直すか削除してください。</translation>
    </message>
    <message>
        <source>{name}: the role “{text}” is not known; write control or check.</source>
        <translation>{name}：役割「{text}」は使えません。control または check と書いてください。</translation>
    </message>
    <message>
        <source>{name} has no column {missing}: points in images need {columns}; x, y, z where their coordinates are known.</source>
        <translation>{name} に列 {missing} がありません。写真上の点には {columns} が必要で、座標の分かる点には x, y, z も要ります。</translation>
    </message>
    <message>
        <source>{name} holds no point in an image.</source>
        <translation>{name} に写真上の点がありません。</translation>
    </message>
    <message>
        <source>{name}: the point {point} is twice in {image}; keep one row.</source>
        <translation>{name}：点 {point} が {image} に2回あります。1行だけ残してください。</translation>
    </message>
    <message>
        <source>{name}: the point {point} has some of x, y and z only; give all three or none.</source>
        <translation>{name}：点 {point} に x、y、z の一部しかありません。すべて書くか、すべて空にしてください。</translation>
    </message>
    <message>
        <source>{name}: the point {point} has two places; keep one.</source>
        <translation>{name}：点 {point} に2つの座標があります。1つだけ残してください。</translation>
    </message>
    <message>
        <source>{frames} frames lie {before:.3f} m off at {count} control points as given and {after:.3f} m after (RMS in plan).</source>
        <translation>写真 {frames} 枚は、標定点 {count} 点で入力のまま {before:.3f} m、調整後 {after:.3f} m ずれています（水平の RMS）。</translation>
    </message>
    <message>
        <source>Each control point left out in turn lies {held:.3f} m off.</source>
        <translation>標定点を1つずつ除くと、その点は {held:.3f} m ずれます。</translation>
    </message>
    <message>
        <source>Check points lie {off:.3f} m off.</source>
        <translation>検証点は {off:.3f} m ずれています。</translation>
    </message>
    <message>
        <source>All control points contradict the frames: check the coordinate system, the order of the angles and the points' names.</source>
        <translation>すべての標定点が写真と矛盾しています。座標系、角度の順序、点名を確認してください。</translation>
    </message>
    <message>
        <source>{count} control points tell a shift of the block, not how it is tilted: measure three or more, far from each other.</source>
        <translation>標定点 {count} 点では全体のずれは分かりますが、傾きは分かりません。離れた3点以上を測ってください。</translation>
    </message>
    <message>
        <source>{count} frames see no control point and follow the others: {names}.</source>
        <translation>標定点の写らない写真 {count} 枚は、ほかの写真に従います：{names}。</translation>
    </message>
    <message>
        <source>The control points lie close together: away from them the frames may be tilted.</source>
        <translation>標定点が狭い範囲に集まっています。離れた場所では写真が傾いているおそれがあります。</translation>
    </message>
    <message>
        <source>the pixel pitch is in micrometres: give millimetres</source>
        <translation>画素ピッチがマイクロメートルで書かれている（ミリメートルで指定）</translation>
    </message>
    <message>
        <source>the pixel pitch is in metres: give millimetres</source>
        <translation>画素ピッチがメートルで書かれている（ミリメートルで指定）</translation>
    </message>
    <message>
        <source>the focal length is in pixels: give millimetres, that is, times the pixel pitch</source>
        <translation>焦点距離が画素数で書かれている（画素ピッチを掛けてミリメートルで指定）</translation>
    </message>
    <message>
        <source>the focal length is in metres: give millimetres</source>
        <translation>焦点距離がメートルで書かれている（ミリメートルで指定）</translation>
    </message>
    <message>
        <source>the heights of the frames are in feet: give metres</source>
        <translation>写真の高さがフィートで書かれている（メートルで指定）</translation>
    </message>
    <message>
        <source>the images were turned by half a turn</source>
        <translation>画像が半回転していた</translation>
    </message>
    <message>
        <source>the images were turned by a quarter turn to the left</source>
        <translation>画像が左に4分の1回転していた</translation>
    </message>
    <message>
        <source>the images were turned by a quarter turn to the right</source>
        <translation>画像が右に4分の1回転していた</translation>
    </message>
    <message>
        <source>kappa were counted from the opposite direction</source>
        <translation>κ が反対の方向から数えられていた</translation>
    </message>
    <message>
        <source>kappa were counted from a quarter turn to the left</source>
        <translation>κ が左へ 4 分の 1 回転した方向から数えられていた</translation>
    </message>
    <message>
        <source>kappa were counted from a quarter turn to the right</source>
        <translation>κ が右へ 4 分の 1 回転した方向から数えられていた</translation>
    </message>
    <message>
        <source>the angles were in gon</source>
        <translation>角度がグラード（gon）だった</translation>
    </message>
    <message>
        <source>the angles were in radians</source>
        <translation>角度がラジアンであった</translation>
    </message>
    <message>
        <source>the angles were in gon and the images turned by half a turn</source>
        <translation>角度がグラード（gon）で、画像が半回転していた</translation>
    </message>
    <message>
        <source>the angles were in gon and kappa counted from the opposite direction</source>
        <translation>角度がグラード（gon）で、κ が反対の方向から数えられていた</translation>
    </message>
    <message>
        <source>the angles were in the usual order of rotations</source>
        <translation>角度が一般的な回転順序だった</translation>
    </message>
    <message>
        <source>the angles had the other sign</source>
        <translation>角度の符号が逆だった</translation>
    </message>
    <message>
        <source>kappa had the other sign</source>
        <translation>κ の符号が逆だった</translation>
    </message>
    <message>
        <source>the heights of the frames were in feet</source>
        <translation>写真の高さがフィートだった</translation>
    </message>
    <message>
        <source>x and y of the frames were swapped</source>
        <translation>写真の x と y が入れ替わっていた</translation>
    </message>
    <message>
        <source>The frames lie below the ground: check the heights in the exterior orientation.</source>
        <translation>空中写真が地表より下にあります。外部標定要素の高さを確認してください。</translation>
    </message>
    <message>
        <source>By the camera and the heights of the frames a pixel is {pixel:.3g} m wide on the ground: no aerial frame has such pixels. Check the focal length, the pixel pitch and the heights{hint}.</source>
        <translation>カメラと写真の高さによると、地上での画素は {pixel:.3g} m になります。そのような空中写真はありません。焦点距離、画素ピッチ、高さを確認してください{hint}。</translation>
    </message>
    <message>
        <source>The principal point lies {offset:.1f} mm from the middle of an image that ends at {half:.1f} mm: give it in millimetres from the middle, not in pixels or from a corner.</source>
        <translation>主点が画像の中心から {offset:.1f} mm にありますが、画像の端は {half:.1f} mm です。画素数や隅からではなく、中心からのミリメートルで指定してください。</translation>
    </message>
    <message>
        <source>The frames contradict each other: by their orientations no two of them show the same ground. They would if {reason}: put that right and run again.</source>
        <translation>写真が互いに矛盾しています。標定によると、同じ地面が写る2枚がありません。{reason}とすれば一致します。直してからもう一度実行してください。</translation>
    </message>
    <message>
        <source>The frames contradict each other: no two of them show the same things where they overlap ({count} pairs compared). Check the camera, the unit, order and signs of the angles, and that each image has its own orientation.</source>
        <translation>写真が互いに矛盾しています。重なる所に同じ物が写る2枚がありません（{count} 組を比較）。カメラ、角度の単位・順序・符号、そして各画像に正しい標定が対応しているかを確認してください。</translation>
    </message>
    <message>
        <source> (what would explain it: {reasons})</source>
        <translation>（考えられる原因：{reasons}）</translation>
    </message>
    <message>
        <source>Images that show other things than those that overlap them: {names}. Check that each has its own orientation, in the right unit, and is not turned or mirrored.</source>
        <translation>重なる画像と別の物が写っている画像：{names}。それぞれの標定が正しい画像のものか、単位が正しいか、回転や反転がないかを確認してください。</translation>
    </message>
    <message>
        <source>{first} and {second} lie {unexplained:.2f} m apart on the road markings {value}(east {east:.2f}, north {north:.2f}, sigma {unexplained_2:.2f}; {patches} places): check their orientation and the ground.</source>
        <translation>{first} と {second} は、路面標示上で {value}{unexplained:.2f} mずれています（東 {east:.2f}、北 {north:.2f}、σ {unexplained_2:.2f}、{patches} 箇所）。標定要素と地表を確認してください。</translation>
    </message>
    <message>
        <source>{bad_count} more pairs of images lie apart.</source>
        <translation>ほかに {bad_count} 組の写真がずれています。</translation>
    </message>
    <message>
        <source>In {hidden} pairs of images the shift may come from the height of what stands on the ground: a surface (DSM) would tell, here only shifts across their base were checked.</source>
        <translation>{hidden} 組の写真のずれは、地上にあるものの高さによる可能性があります。表層（DSM）があれば判別できますが、ここでは基線に直交する方向のずれだけを検査しました。</translation>
    </message>
    <message>
        <source>across their base </source>
        <translation>基線に直交する方向に </translation>
    </message>
    <message>
        <source>No frame shows any of the ground: check that frames, exterior orientation and ground lie in the same place and coordinate system.</source>
        <translation>地表が写っている空中写真がありません。空中写真、外部標定要素、地表の場所と座標系が一致しているか確認してください。</translation>
    </message>
    <message>
        <source>The images hold {dtype} numbers: convert them to 8 or 16 bit without sign.</source>
        <translation>画像の数値は {dtype} です。符号なしの8ビットまたは16ビットに変換してください。</translation>
    </message>
    <message>
        <source>No frame sees any ground there: check that frames, exterior orientation, ground and surface lie in the same place and coordinate system.</source>
        <translation>そこの地表が写っている空中写真がありません。空中写真、外部標定要素、地表、表層の場所と座標系が一致しているか確認してください。</translation>
    </message>
    <message>
        <source>The coordinate reference system cannot be understood: set another one.</source>
        <translation>座標参照系を解釈できません。別の座標参照系を設定してください。</translation>
    </message>
    <message>
        <source>{image} cannot be written ({error}): choose another output.</source>
        <translation>{image} に書き込めません（{error}）。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>{path} holds no heights: check the raster.</source>
        <translation>{path} に高さがありません。ラスタを確認してください。</translation>
    </message>
    <message>
        <source>Occlusion maps of the frames need a surface (DSM): give one, or give the maps themselves.</source>
        <translation>空中写真の遮蔽図には表層（DSM）が必要です。表層または遮蔽図そのものを指定してください。</translation>
    </message>
    <message>
        <source>{beside_count} frames show none of the ground and are left out: {beside}{value}.</source>
        <translation>地表が写っていない {beside_count} 枚の空中写真を除きます: {beside}{value}。</translation>
    </message>
    <message>
        <source>Without a surface (DSM) buildings cannot be told to hide the ground: they lie over it in the mosaic.</source>
        <translation>表層（DSM）がないため、建物が地表を隠すことを判別できません。モザイクでは建物が地表に重なります。</translation>
    </message>
    <message>
        <source>The surface (DSM) does not cover the whole mosaic: beyond it buildings lie over the ground.</source>
        <translation>表層（DSM）がモザイクの全体を覆っていません。その外では建物が地表に重なります。</translation>
    </message>
    <message>
        <source>{path} has {kind} bands of {kind_2} but {path_2} {kinds} of {kinds_2}: give frames of one kind.</source>
        <translation>{path} は {kind_2} の {kind} バンドですが、{path_2} は {kinds_2} の {kinds} バンドです。同じ種類の空中写真を指定してください。</translation>
    </message>
    <message>
        <source> and others</source>
        <translation> ほか</translation>
    </message>
    <message>
        <source>{name} says where it lies in numbers that are not finite: it is damaged; export it again.</source>
        <translation>{name} の位置情報に有限でない数値があります。破損しているため、再度出力してください。</translation>
    </message>
    <message>
        <source>{name} is turned or its pixels are not square: warp it to a north-up raster first.</source>
        <translation>{name} は回転しているか、画素が正方形ではありません。先に北を上としたラスタに再標本化してください。</translation>
    </message>
    <message>
        <source>Vehicles can only be told by comparing: give two or more orthophotos of the same ground.</source>
        <translation>車両は比較によってのみ判別できます。同じ地表のオルソ画像を2枚以上指定してください。</translation>
    </message>
    <message>
        <source>{name} has no coordinate reference system: set it first.</source>
        <translation>{name} に座標参照系がありません。先に設定してください。</translation>
    </message>
    <message>
        <source>{source} has {bands} bands of {dtype} but {first} {bands_2} of {dtype_2}: give orthophotos of one kind.</source>
        <translation>{source} は {dtype} の {bands} バンドですが、{first} は {dtype_2} の {bands_2} バンドです。同じ種類のオルソ画像を指定してください。</translation>
    </message>
    <message>
        <source>No two of the orthophotos show the same ground: no vehicle was filtered.</source>
        <translation>同じ地表が写っているオルソ画像の組がないため、車両は除去されませんでした。</translation>
    </message>
    <message>
        <source>{name} is damaged: {error}.</source>
        <translation>{name} は破損しています: {error}。</translation>
    </message>
    <message>
        <source>{name} cannot be read as an image: check the file.</source>
        <translation>{name} を画像として読み込めません。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>level roofs, as the sloped solid is not valid ({problems})</source>
        <translation>勾配屋根の立体が有効でないため陸屋根としました（{problems}）</translation>
    </message>
    <message>
        <source>one height for all roofs, as the detailed solid is not valid ({problems})</source>
        <translation>詳細な立体が有効でないため、全屋根を一つの高さとしました（{problems}）</translation>
    </message>
    <message>
        <source>no valid solid could be made ({left})</source>
        <translation>有効な立体を作成できませんでした（{left}）</translation>
    </message>
    <message>
        <source>no roof was found in its points</source>
        <translation>点から屋根が見つかりませんでした</translation>
    </message>
    <message>
        <source>its ground is not known, {source}</source>
        <translation>地表の高さが不明です（{source}）</translation>
    </message>
    <message>
        <source>too few points for roofs; {note}</source>
        <translation>屋根を作るには点が少なすぎます；{note}</translation>
    </message>
    <message>
        <source>{paths} has no attribute {name}: run “{maker}” first and give its result.</source>
        <translation>{paths} に属性 {name} がありません。先に「{maker}」を実行し、その結果を指定してください。</translation>
    </message>
    <message>
        <source>low</source>
        <translation>低い</translation>
    </message>
    <message>
        <source>movable</source>
        <translation>移動体の可能性</translation>
    </message>
    <message>
        <source>deck</source>
        <translation>橋・斜路</translation>
    </message>
    <message>
        <source>no ground</source>
        <translation>周囲に地面なし</translation>
    </message>
    <message>
        <source>It is {height:.1f} m high.</source>
        <translation>高さは {height:.1f} m です。</translation>
    </message>
    <message>
        <source>{length:.1f} m by {width:.1f} m, {height:.1f} m high: it may be a vehicle or a container.</source>
        <translation>{length:.1f} m × {width:.1f} m、高さ {height:.1f} m。車両またはコンテナの可能性があります。</translation>
    </message>
    <message>
        <source>{share:.0%} of its edge goes on into the ground without a step.</source>
        <translation>縁の {share:.0%} が段差なく地面に続いています。</translation>
    </message>
    <message>
        <source>Ground was seen along {share:.0%} of its edge only.</source>
        <translation>外周のうち {share:.0%} でしか地面が観測されていません。</translation>
    </message>
    <message>
        <source>{count} buildings were found.</source>
        <translation>建物が {count} 棟見つかりました。</translation>
    </message>
    <message>
        <source>{count} outlines may be no buildings; the table tells why.</source>
        <translation>{count} 件の外周線は建物でない可能性があります。理由は表にあります。</translation>
    </message>
    <message>
        <source>No point of the cloud lies on a roof: check that it shows buildings and that its heights are in metres.</source>
        <translation>屋根にある点が見つかりません。点群に建物が含まれ、高さの単位がメートルであることを確認してください。</translation>
    </message>
    <message>
        <source>classes</source>
        <translation>分類クラス</translation>
    </message>
    <message>
        <source>echoes</source>
        <translation>反射</translation>
    </message>
    <message>
        <source>surfaces</source>
        <translation>面</translation>
    </message>
    <message>
        <source>A part of the model has no height: give finite heights.</source>
        <translation>モデルの一部に高さがありません。有限の高さを指定してください。</translation>
    </message>
    <message>
        <source>The model has no parts.</source>
        <translation>モデルに部分がありません。</translation>
    </message>
    <message>
        <source>The model has no part with a volume.</source>
        <translation>モデルに体積のある部分がありません。</translation>
    </message>
    <message>
        <source>{status} of {merged_count} buildings have walls that lie on measured ones now.</source>
        <translation>{merged_count} 棟中 {status} 棟の壁面が計測壁面に一致しました。</translation>
    </message>
    <message>
        <source> {status} could not be merged and keep their models; the table tells why.</source>
        <translation> {status} 棟は統合できず元のモデルのままです。理由は表にあります。</translation>
    </message>
    <message>
        <source>Buildings by the largest offset of a wall. Offsets of metres hint at another building, or another date.</source>
        <translation>壁面の最大オフセット別の建物。数mのオフセットは、別の建物か別の時期であることを示します。</translation>
    </message>
    <message>
        <source>Unchanged: {count}; the table tells why.</source>
        <translation>変更なし：{count}。理由は表にあります。</translation>
    </message>
    <message>
        <source>not merged</source>
        <translation>統合なし</translation>
    </message>
    <message>
        <source>its measured walls are beyond the limits</source>
        <translation>計測壁面が許容範囲を超えています</translation>
    </message>
    <message>
        <source>the measured walls fit the model</source>
        <translation>計測壁面はモデルに合っています</translation>
    </message>
    <message>
        <source>no measured wall runs along it</source>
        <translation>沿って計測された壁面がありません</translation>
    </message>
    <message>
        <source>Two buildings have the same building_id: give each building its own.</source>
        <translation>2つの建物のbuilding_idが同じです。建物ごとに異なるbuilding_idを付けてください。</translation>
    </message>
    <message>
        <source>There are no measured walls: run “Walls from a mobile survey” first and check that it found any.</source>
        <translation>計測壁面がありません。先に「MMS計測の壁面」を実行し、壁面が見つかったか確認してください。</translation>
    </message>
    <message>
        <source>Building {flat} has no heights: give building models (MultiPolygonZ), not outlines.</source>
        <translation>建物 {flat} に高さがありません。外周線ではなく建物モデル（MultiPolygonZ）を指定してください。</translation>
    </message>
    <message>
        <source>No measured wall lies near any model: check that both are of the same place, and that the survey has been put on the map.</source>
        <translation>モデルの近くに計測壁面がありません。両者が同じ場所のもので、MMS計測が地図に位置合わせされているか確認してください。</translation>
    </message>
    <message>
        <source>no valid solid could be made with it ({trouble})</source>
        <translation>これを用いると有効な立体を作成できません（{trouble}）</translation>
    </message>
    <message>
        <source>no valid solid could be made with the measured walls ({trouble})</source>
        <translation>計測壁面を用いると有効な立体を作成できません（{trouble}）</translation>
    </message>
    <message>
        <source>the plan would fold over itself</source>
        <translation>平面形が自身と重なってしまいます</translation>
    </message>
    <message>
        <source>it has no model</source>
        <translation>モデルがありません</translation>
    </message>
    <message>
        <source>it has sloped roofs and is higher than the walls are taken</source>
        <translation>勾配屋根があり、壁面を採用する高さより高い建物です</translation>
    </message>
    <message>
        <source>the measured wall lies in the neighbour {building_id}</source>
        <translation>計測壁面が隣の建物 {building_id} の中にあります</translation>
    </message>
    <message>
        <source>{fspath} holds no building: give a CityJSON file with buildings.</source>
        <translation>{fspath} に建物がありません。建物を含むCityJSONファイルを指定してください。</translation>
    </message>
    <message>
        <source>it has no heights</source>
        <translation>高さがありません</translation>
    </message>
    <message>
        <source>it has no roof or no ground on one level</source>
        <translation>屋根がないか、底面が一つの高さにありません</translation>
    </message>
    <message>
        <source>its roofs do not lie over its ground: overhangs or a second ground</source>
        <translation>屋根が底面の上にありません：張り出し、または別の底面</translation>
    </message>
    <message>
        <source>a sloped face of it is not plane</source>
        <translation>傾斜面が平面ではありません</translation>
    </message>
    <message>
        <source>satellites put it {away:.1f} m {value} of there (sigma {sigma:.2f} m)</source>
        <translation>衛星によればそこから{away:.1f} m {value}です（標準偏差 {sigma:.2f} m）</translation>
    </message>
    <message>
        <source>by satellites ({status}): {offset:+.2f} m, sigma {sigma:.2f} m</source>
        <translation>衛星による（{status}）：{offset:+.2f} m、標準偏差 {sigma:.2f} m</translation>
    </message>
    <message>
        <source>A wall by satellites needs a sigma greater than 0.</source>
        <translation>衛星による壁面には0より大きい標準偏差が必要です。</translation>
    </message>
    <message>
        <source>outside</source>
        <translation>外側</translation>
    </message>
    <message>
        <source>inside</source>
        <translation>内側</translation>
    </message>
    <message>
        <source>moved</source>
        <translation>移動</translation>
    </message>
    <message>
        <source>fits</source>
        <translation>一致</translation>
    </message>
    <message>
        <source>not seen</source>
        <translation>未計測</translation>
    </message>
    <message>
        <source>too far</source>
        <translation>遠すぎる</translation>
    </message>
    <message>
        <source>neighbour</source>
        <translation>隣の建物に当たる</translation>
    </message>
    <message>
        <source>does not fit</source>
        <translation>成り立たない</translation>
    </message>
    <message>
        <source>the measured wall is rotated by {rotation:.1f} degrees against it</source>
        <translation>計測壁面が {rotation:.1f} 度回転しています</translation>
    </message>
    <message>
        <source>{others_count} more wall{value} at another depth along it</source>
        <translation>沿って別の奥行きの壁面がさらに {others_count} 面あります</translation>
    </message>
    <message>
        <source>the wall was measured {offset:.2f} m {value} of it</source>
        <translation>壁面はモデルから {offset:.2f} m の位置で計測されました（{value}）</translation>
    </message>
    <message>
        <source>the facade along it is not straight</source>
        <translation>この面に沿う壁面は直線ではありません</translation>
    </message>
    <message>
        <source>an end would move too far</source>
        <translation>端の移動量が大きすぎます</translation>
    </message>
    <message>
        <source>only {points_count} points lie in it</source>
        <translation>内側の点が {points_count} 個しかありません</translation>
    </message>
    <message>
        <source>none of its points lies on its outline</source>
        <translation>外周線上に点がありません</translation>
    </message>
    <message>
        <source>No point lies in any outline: check that both are of the same place and CRS.</source>
        <translation>どの外周線の内側にも点がありません。両者の場所とCRSが同じか確認してください。</translation>
    </message>
    <message>
        <source>its ground is not known, the foot is put {storey:g} m under its lowest roof</source>
        <translation>地表の高さが不明のため、底面を最も低い屋根の {storey:g} m 下としました</translation>
    </message>
    <message>
        <source>only {within:.0f} % of its uppermost points lie within {max_error:g} m</source>
        <translation>最上部の点のうち {max_error:g} m 以内は {within:.0f} % だけです</translation>
    </message>
    <message>
        <source>{under:.0f} % of its points lie under the uppermost surface, which alone is meshed</source>
        <translation>点の {under:.0f} % は最上面より下にあります。メッシュは最上面だけです</translation>
    </message>
    <message>
        <source>its surfaces touch or cross somewhere</source>
        <translation>面がどこかで接触または交差しています</translation>
    </message>
    <message>
        <source>it has no outline</source>
        <translation>外周線がありません</translation>
    </message>
    <message>
        <source>no closed mesh could be made</source>
        <translation>閉じたメッシュを作成できませんでした</translation>
    </message>
    <message>
        <source>its outline has no area</source>
        <translation>外周線に面積がありません</translation>
    </message>
    <message>
        <source>No roof has a building_id that the outlines have: give the outlines that the roofs were made with.</source>
        <translation>外周線のbuilding_idをもつ屋根がありません。屋根の作成に用いた外周線を指定してください。</translation>
    </message>
    <message>
        <source>Half of the roofs lie more than {height:.0f} m above the ground: the heights of points or ground are in other units, such as centimetres; export them in metres.</source>
        <translation>屋根の半分が地上 {height:.0f} m より高い位置にあります。点群または地面の高さが別の単位(センチメートルなど)になっています。メートルで書き出してください。</translation>
    </message>
    <message>
        <source>a tower, {height:.0f} m high</source>
        <translation>高さ{height:.0f} mの高層建物です</translation>
    </message>
    <message>
        <source>curved walls are drawn as short straight ones</source>
        <translation>曲面の壁は短い直線で表しています</translation>
    </message>
    <message>
        <source>{not_explained:.0f} % of the points that can be roof are not explained by the model, RMSE of height (best 95 %) {rmse_z95:.1f} m</source>
        <translation>屋根となり得る点の {not_explained:.0f} % がモデルで説明されません。高さのRMSE（良い方の95 %） {rmse_z95:.1f} m</translation>
    </message>
    <message>
        <source>a roof found in its points has no polygon</source>
        <translation>点から見つかった屋根にポリゴンがありません</translation>
    </message>
    <message>
        <source>only {height:.2f} m over the ground</source>
        <translation>地表から {height:.2f} m しかありません</translation>
    </message>
    <message>
        <source>{area:.0f} % of its outline has no model</source>
        <translation>外周線の {area:.0f} % にモデルがありません</translation>
    </message>
    <message>
        <source>the point cloud ends in it: {beyond:.0f} % of its outline lies beyond</source>
        <translation>点群が建物の途中で終わっています。外周線内の {beyond:.0f} % がその外にあります</translation>
    </message>
    <message>
        <source>{unseen:.0f} % of its plan has no roof points</source>
        <translation>平面の {unseen:.0f} % に屋根の点がありません</translation>
    </message>
    <message>
        <source>only {points:.0f} points</source>
        <translation>点は{points:.0f}点だけです</translation>
    </message>
    <message>
        <source>only {area:.1f} m2</source>
        <translation>面積は{area:.1f} m²だけです</translation>
    </message>
    <message>
        <source>The worst {worst_count}</source>
        <translation>最も悪い {worst_count} 件</translation>
    </message>
    <message>
        <source>status</source>
        <translation>状態</translation>
    </message>
    <message>
        <source>roofs</source>
        <translation>屋根</translation>
    </message>
    <message>
        <source>why</source>
        <translation>理由</translation>
    </message>
    <message>
        <source>Buildings by quality. Those far left are to be looked at first.</source>
        <translation>品質別の建物。左端のものから確認してください。</translation>
    </message>
    <message>
        <source>{good} of {count} buildings have a model that explains their points.</source>
        <translation>{count} 棟中 {good} 棟に、点を説明できるモデルがあります。</translation>
    </message>
    <message>
        <source>{good} of {count} buildings have a valid model. How well it fits is not known: no points were given.</source>
        <translation>{count} 棟中 {good} 棟に有効なモデルがあります。点が与えられていないため、適合の良さは不明です。</translation>
    </message>
    <message>
        <source>RMSE of height, best 95 %, of each building; the worst are numbered. North is up. Red ones side by side hint at a shift or another date; single ones at their roofs.</source>
        <translation>各建物の高さのRMSE（良い方の95 %）。悪いものに番号を付けています。上が北です。赤い建物が並ぶ場合はずれや時期の違い、単独の場合は屋根の問題が考えられます。</translation>
    </message>
    <message>
        <source>With a remark: {others}; look at the worst below first.</source>
        <translation>注記あり：{others}。まず下の悪いものを確認してください。</translation>
    </message>
    <message>
        <source>Without a model: {missing}; they keep their rows, with the reason, in the result.</source>
        <translation>モデルなし：{missing}。結果には理由とともに行が残ります。</translation>
    </message>
    <message>
        <source>only {density:.1f} points a m²</source>
        <translation>点密度は{density:.1f}点/m²だけです</translation>
    </message>
    <message>
        <source>{coverage:.0f} % of its points lie beside the model: check the outline</source>
        <translation>点の {coverage:.0f} % がモデルの外にあります：外周線を確認してください</translation>
    </message>
    <message>
        <source>its roofs do not follow the points: a broken roof, or points of something else</source>
        <translation>屋根が点に沿っていません：複雑な屋根か、別の物の点です</translation>
    </message>
    <message>
        <source>sloped or uneven roofs are modelled level</source>
        <translation>勾配のある屋根や凹凸のある屋根を陸屋根で表しています</translation>
    </message>
    <message>
        <source>The building evidence does not lie on its grid: give both the same rows and columns.</source>
        <translation>建物の根拠データがそのグリッドと一致しません。行数と列数を同じにしてください。</translation>
    </message>
    <message>
        <source>The longest shift of an outline must be at least {coarse_step} m.</source>
        <translation>外周線の最大移動量は {coarse_step} m以上としてください。</translation>
    </message>
    <message>
        <source>The point density is not a positive number: check that the points cover the outlines.</source>
        <translation>点密度が正の数ではありません。点が外周線を覆っているか確認してください。</translation>
    </message>
    <message>
        <source>The ground heights do not lie on the grid of the evidence: give both the same grid.</source>
        <translation>地表の標高が根拠データのグリッドと一致しません。同じグリッドとしてください。</translation>
    </message>
    <message>
        <source>the outline was invalid and was repaired</source>
        <translation>外周線が無効なため修復しました</translation>
    </message>
    <message>
        <source>The layer of building outlines is empty: give a layer with polygons.</source>
        <translation>建物外周線のレイヤが空です。ポリゴンのあるレイヤを指定してください。</translation>
    </message>
    <message>
        <source>No building outline has a usable polygon: check the outlines' geometries.</source>
        <translation>使用できるポリゴンをもつ建物外周線がありません。外周線のジオメトリを確認してください。</translation>
    </message>
    <message>
        <source>Some building_id of the outlines is empty or no whole number: number the outlines or remove the field.</source>
        <translation>外周線のbuilding_idに空または整数でないものがあります。外周線に番号を付けるか、フィールドを削除してください。</translation>
    </message>
    <message>
        <source>Some building_id of the outlines is below 1 or too large: number the outlines from 1 or remove the field.</source>
        <translation>外周線のbuilding_idに1未満または大きすぎるものがあります。外周線に1から番号を付けるか、フィールドを削除してください。</translation>
    </message>
    <message>
        <source>The outlines hold the building_id {unique} more than once: make it unique or remove the field.</source>
        <translation>外周線にbuilding_id {unique} が重複しています。一意にするか、フィールドを削除してください。</translation>
    </message>
    <message>
        <source>the outline is empty</source>
        <translation>外周線が空です</translation>
    </message>
    <message>
        <source>the outline has coordinates that are not numbers</source>
        <translation>外周線の座標に数値でないものがあります</translation>
    </message>
    <message>
        <source>the outline has no area</source>
        <translation>外周線に面積がありません</translation>
    </message>
    <message>
        <source>its outline is dated {begin}, after the flight of {flown}: what the points show may be what stood there before</source>
        <translation>外周線の日付 {begin} は計測日 {flown} より後です。点が示すのは以前の建物かもしれません</translation>
    </message>
    <message>
        <source>its outline ended on {end}, before the flight of {flown}: the building may be gone</source>
        <translation>外周線は計測日 {flown} より前の {end} に消滅しています。建物はもうないかもしれません</translation>
    </message>
    <message>
        <source>its points lie on so many planes that they would cut its plan into about {faces:.0f} faces, more than {most}</source>
        <translation>点群が多数の平面に分かれ、平面図が約{faces:.0f}面（上限{most}面）に分割されてしまいます</translation>
    </message>
    <message>
        <source>the roof polygons overlap or leave gaps</source>
        <translation>屋根ポリゴンに重なりまたは隙間があります</translation>
    </message>
    <message>
        <source>a roof cannot be cut into triangles: {error}</source>
        <translation>屋根を三角形に分割できません：{error}</translation>
    </message>
    <message>
        <source>A detected line needs at least three boundary points.</source>
        <translation>検出する線には3個以上の境界点が必要です。</translation>
    </message>
    <message>
        <source>The distance of boundary points to their line must be above zero metres.</source>
        <translation>境界点から線までの距離は0 mより大きくしてください。</translation>
    </message>
    <message>
        <source>The point density must be above zero points per square metre.</source>
        <translation>点密度は0点/m²より大きくしてください。</translation>
    </message>
    <message>
        <source>The building's points are too few to draw an outline from them.</source>
        <translation>建物の点が少なすぎて、外周を描けません。</translation>
    </message>
    <message>
        <source>The building's points lie on its neighbours: check the building outlines.</source>
        <translation>建物の点が隣の建物の上にあります。建物外周線を確認してください。</translation>
    </message>
    <message>
        <source>The outlier radius must be above zero metres.</source>
        <translation>外れ値の半径は0 mより大きくしてください。</translation>
    </message>
    <message>
        <source>An outline needs at least four boundary points to be regularised.</source>
        <translation>外周線の整形には4個以上の境界点が必要です。</translation>
    </message>
    <message>
        <source>A roof polygon needs at least three edges: lower the least number of edge points.</source>
        <translation>屋根ポリゴンには3辺以上が必要です。辺の最小点数を小さくしてください。</translation>
    </message>
    <message>
        <source>Building {number} has no roofs: {words}.</source>
        <translation>建物{number}には屋根がありません：{words}。</translation>
    </message>
    <message>
        <source>The bin width and the bin shift of the height histogram must be more than 0.</source>
        <translation>高さヒストグラムの階級幅と階級のずらし量は0より大きくしてください。</translation>
    </message>
    <message>
        <source>Some point heights are not numbers: remove these points first.</source>
        <translation>点の高さに数値でないものがあります。先にそれらの点を除いてください。</translation>
    </message>
    <message>
        <source>The heights of a building's points span too many bins: remove outliers first.</source>
        <translation>建物の点の高さの範囲が広く、階級の数が多すぎます。外れ値を除いてください。</translation>
    </message>
    <message>
        <source>The x, y and z of a building's points differ in number.</source>
        <translation>建物の点のx、y、zの個数が一致しません。</translation>
    </message>
    <message>
        <source>Some coordinates of a building's points are not numbers: remove them.</source>
        <translation>建物の点の座標に数値でないものがあります。除いてください。</translation>
    </message>
    <message>
        <source>A building's ground height and point density must be numbers, density above 0.</source>
        <translation>建物の地盤の標高と点密度は数値とし、密度は0より大きくしてください。</translation>
    </message>
    <message>
        <source>All points of {name} are marked as noise or as withheld: take the marks off, or export the points without them.</source>
        <translation>{name} のすべての点にノイズまたは除外(withheld)の印が付いています。印を外すか、印のない点を書き出してください。</translation>
    </message>
    <message>
        <source>No sound point lies near any outline: check that points and outlines are of the same place, and that coordinates and heights are in metres.</source>
        <translation>外周線の近くに正常な点がありません。点と外周線の場所が同じで、座標と高さがメートル単位か確認してください。</translation>
    </message>
    <message>
        <source>The point cloud and the outlines do not overlap: check that both are of the same place and that their coordinate reference systems are set right.</source>
        <translation>点群と外周線が重なりません。場所が同じで、座標参照系が正しく設定されているか確認してください。</translation>
    </message>
    <message>
        <source>The building has no base height: give the ground's height in metres.</source>
        <translation>建物に基準高がありません。地盤の標高をメートルで指定してください。</translation>
    </message>
    <message>
        <source>Cells of one building overlap: cut its plan with partition_plan first.</source>
        <translation>1つの建物のセルが重なっています。先にpartition_planで平面を分割してください。</translation>
    </message>
    <message>
        <source>No roof of the building has an area: check outline and roofs.</source>
        <translation>建物のどの屋根にも面積がありません: 外周線と屋根を確認してください。</translation>
    </message>
    <message>
        <source>Roof polygons, heights and ids differ in number: give one height and id for each roof.</source>
        <translation>屋根ポリゴン、高さ、idの個数が一致しません。屋根ごとに高さとidを1つずつ指定してください。</translation>
    </message>
    <message>
        <source>The building has no roof: give at least one.</source>
        <translation>建物に屋根がありません。1つ以上指定してください。</translation>
    </message>
    <message>
        <source>A roof has no height: give a finite height for each roof.</source>
        <translation>屋根に高さがありません。各屋根に有限の高さを指定してください。</translation>
    </message>
    <message>
        <source>has rings that intersect</source>
        <translation>交差する輪があります</translation>
    </message>
    <message>
        <source>Face {face} {text}.</source>
        <translation>面 {face}: {text}。</translation>
    </message>
    <message>
        <source>is collapsed to a line</source>
        <translation>線につぶれています</translation>
    </message>
    <message>
        <source>has a ring that intersects itself</source>
        <translation>自分自身と交差する輪があります</translation>
    </message>
    <message>
        <source>has the same ring twice</source>
        <translation>同じ輪が二つあります</translation>
    </message>
    <message>
        <source>has an inner ring outside the outer one</source>
        <translation>外側の輪の外に内側の輪があります</translation>
    </message>
    <message>
        <source>has an inner ring within another one</source>
        <translation>内側の輪の中に内側の輪があります</translation>
    </message>
    <message>
        <source>falls apart at points where its rings touch</source>
        <translation>輪が接する点で分離しています</translation>
    </message>
    <message>
        <source>An edge belongs to one face only: the shell has a hole.</source>
        <translation>1つの面にしか属さない辺があります。シェルに穴があります。</translation>
    </message>
    <message>
        <source>{uses} faces meet in one edge.</source>
        <translation>一つの辺に {uses} 面が接しています。</translation>
    </message>
    <message>
        <source>Faces touch each other only in this point.</source>
        <translation>面どうしがこの点だけで接しています。</translation>
    </message>
    <message>
        <source>and others are not connected to the rest of the shell</source>
        <translation>ほかの面が殻の残りとつながっていません</translation>
    </message>
    <message>
        <source>The solid has no faces.</source>
        <translation>立体に面がありません。</translation>
    </message>
    <message>
        <source>A face of the solid names a vertex that does not exist: the model is damaged.</source>
        <translation>立体の面が存在しない頂点を参照しています。モデルが破損しています。</translation>
    </message>
    <message>
        <source>A vertex of the solid is not a finite number: the model is damaged.</source>
        <translation>立体の頂点が有限の数値ではありません。モデルが破損しています。</translation>
    </message>
    <message>
        <source>A face of the solid has an empty ring: the model is damaged.</source>
        <translation>立体の面に空のリングがあります。モデルが破損しています。</translation>
    </message>
    <message>
        <source>Face {face_of} repeats a point.</source>
        <translation>面 {face_of} に同じ点の繰返しがあります。</translation>
    </message>
    <message>
        <source>has a ring of fewer than 3 points</source>
        <translation>3点未満の輪があります</translation>
    </message>
    <message>
        <source>Face {face} has a point {off:.4f} m off its plane.</source>
        <translation>面 {face} に、平面から {off:.4f} m離れた点があります。</translation>
    </message>
    <message>
        <source>The shell has {face_count} faces: the least is 4.</source>
        <translation>シェルの面が {face_count} 個です。4個以上必要です。</translation>
    </message>
    <message>
        <source>Face {face_of} and its neighbour turn opposite ways at their edge.</source>
        <translation>面 {face_of} とその隣の面の向きが、共有する辺で逆になっています。</translation>
    </message>
    <message>
        <source>An edge of face {owners} runs into face {face}.</source>
        <translation>面 {owners} の辺が面 {face} に交差しています。</translation>
    </message>
    <message>
        <source>The faces look inwards.</source>
        <translation>面が内側を向いています。</translation>
    </message>
    <message>
        <source>A ring of face {face_of} visits a point twice.</source>
        <translation>面 {face_of} のリングが同じ点を2回通っています。</translation>
    </message>
    <message>
        <source>has an inner ring that turns like the outer one</source>
        <translation>内側の輪が外側と同じ向きです</translation>
    </message>
    <message>
        <source>has a fold of {angle:.0f} degrees</source>
        <translation>{angle:.0f} 度の折れがあります</translation>
    </message>
    <message>
        <source>{area:.0f} m2 of its roof differ by {height:+.1f} m.</source>
        <translation>屋根の {area:.0f} m2 が {height:+.1f} m 異なります。</translation>
    </message>
    <message>
        <source>Ground lies under {area:.0f} m2 of it.</source>
        <translation>その {area:.0f} m2 の範囲が地面になっています。</translation>
    </message>
    <message>
        <source>The new points show {seen:.0%} of it.</source>
        <translation>新しい点群で見えるのは {seen:.0%} です。</translation>
    </message>
    <message>
        <source>Ground lies where it stood.</source>
        <translation>建物のあった場所が地面になっています。</translation>
    </message>
    <message>
        <source>All of its roof lies {height:+.1f} m or more off the block.</source>
        <translation>屋根全体がブロックの高さから{height:+.1f} m以上ずれています。</translation>
    </message>
    <message>
        <source>Its old heights are not known.</source>
        <translation>元の高さが不明です。</translation>
    </message>
    <message>
        <source>{area:.0f} m2 of roof, {height:.1f} m high, where no building was.</source>
        <translation>建物のなかった場所に、高さ {height:.1f} m、{area:.0f} m2 の屋根があります。</translation>
    </message>
    <message>
        <source>No new point lies inside an old building: check that both are of the same place and in the same coordinate system.</source>
        <translation>既存の建物の内側に新しい点がありません。両者が同じ場所で、同じ座標参照系であることを確認してください。</translation>
    </message>
    <message>
        <source>{area:.0f} m2 were built on to it.</source>
        <translation>{area:.0f} m2 が増築されました。</translation>
    </message>
    <message>
        <source>{changed} of {count} buildings changed, {same} are the same, {unseen} were not seen.</source>
        <translation>{count} 棟のうち {changed} 棟が変化し、{same} 棟は変化なし、{unseen} 棟は未観測です。</translation>
    </message>
    <message>
        <source>The new points lie this far from the old model as a whole, which counts as no change.</source>
        <translation>新しい点群は既存モデルから全体としてこれだけずれています。これは変化として数えません。</translation>
    </message>
    <message>
        <source>a list of codes</source>
        <translation>コードリスト</translation>
    </message>
    <message>
        <source>a city model</source>
        <translation>都市モデル</translation>
    </message>
    <message>
        <source>needs the reference data; the table of instances has the numbers to compare</source>
        <translation>参照データが必要です。比較する数は地物インスタンス数の表にあります</translation>
    </message>
    <message>
        <source>needs the reference data and eyes</source>
        <translation>参照データと目視が必要です</translation>
    </message>
    <message>
        <source>needs the city's own list of attributes</source>
        <translation>都市ごとの取得項目一覧が必要です</translation>
    </message>
    <message>
        <source>only in part: the root, values and coordinates; the schema needs a validator</source>
        <translation>一部のみ（ルート要素・値・座標）。スキーマ全体には検証ソフトウェアが必要です</translation>
    </message>
    <message>
        <source>has no rule here</source>
        <translation>この検査には規則がありません</translation>
    </message>
    <message>
        <source>needs the BIM model</source>
        <translation>BIM モデルが必要です</translation>
    </message>
    <message>
        <source>needs the BIM model and eyes</source>
        <translation>BIM モデルと目視が必要です</translation>
    </message>
    <message>
        <source>{objects} city objects in {files} files: {errors} errors, {warnings} warnings.</source>
        <translation>{files} ファイル、地物 {objects} 件: エラー {errors} 件、警告 {warnings} 件。</translation>
    </message>
    <message>
        <source>Check of a city model</source>
        <translation>3D都市モデルの検査</translation>
    </message>
    <message>
        <source>Instances</source>
        <translation>地物インスタンス数</translation>
    </message>
    <message>
        <source>Not checked</source>
        <translation>検査していない項目</translation>
    </message>
    <message>
        <source>Requirements</source>
        <translation>品質要求</translation>
    </message>
    <message>
        <source>not met</source>
        <translation>不適合</translation>
    </message>
    <message>
        <source>left out</source>
        <translation>対象外（除外）</translation>
    </message>
    <message>
        <source>nothing to check</source>
        <translation>対象なし</translation>
    </message>
    <message>
        <source>met in part</source>
        <translation>一部のみ検査・適合</translation>
    </message>
    <message>
        <source>met</source>
        <translation>適合</translation>
    </message>
    <message>
        <source>The data set does not pass: put the errors right, the commonest first.</source>
        <translation>不合格です。件数の多いものからエラーを修正してください。</translation>
    </message>
    <message>
        <source>Type</source>
        <translation>地物型</translation>
    </message>
    <message>
        <source>Number</source>
        <translation>数</translation>
    </message>
    <message>
        <source>Requirement</source>
        <translation>品質要求</translation>
    </message>
    <message>
        <source>Why</source>
        <translation>理由</translation>
    </message>
    <message>
        <source>Files</source>
        <translation>ファイル</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>判定</translation>
    </message>
    <message>
        <source>It passes what is checked here; look at the warnings before it is delivered.</source>
        <translation>ここで検査した項目は合格です。納品前に警告を確認してください。</translation>
    </message>
    <message>
        <source>Faults of {code}</source>
        <translation>{code} の不適合</translation>
    </message>
    <message>
        <source>File</source>
        <translation>ファイル</translation>
    </message>
    <message>
        <source>Feature</source>
        <translation>地物</translation>
    </message>
    <message>
        <source>Id</source>
        <translation>識別子</translation>
    </message>
    <message>
        <source>What</source>
        <translation>内容</translation>
    </message>
    <message>
        <source>The first {shown} of {number} are shown; the layer holds all.</source>
        <translation>{number} 件のうち先頭の {shown} 件を示します。すべてはレイヤにあります。</translation>
    </message>
    <message>
        <source>There is nothing to check but the files.</source>
        <translation>検査できる地物がありません（ファイルだけを検査しました）。</translation>
    </message>
    <message>
        <source>{roads} roads, {things} things of city furniture and trees are written, too.</source>
        <translation>道路{roads}件、都市設備と樹木{things}件も書き出されます。</translation>
    </message>
    <message>
        <source>{bare} of the roads, city furniture and trees have no surfaces: CityJSON has them without a shape, 3D Tiles and PLATEAU's CityGML leave them out.</source>
        <translation>道路、都市設備、樹木のうち{bare}件には面がありません。CityJSONには形状なしで書かれ、3D TilesとPLATEAUのCityGMLには含まれません。</translation>
    </message>
    <message>
        <source>CityGML states heights in JGD2011 (EPSG:6697), but those of the models are {heights}: give the height system, or convert the heights, if they are others.</source>
        <translation>CityGMLでは標高をJGD2011（EPSG:6697）としますが、モデルの高さの基準は {heights} です。異なる場合は、高さの基準を指定するか、標高を変換してください。</translation>
    </message>
    <message>
        <source>{missing} buildings have no model and no place in a mesh: CityGML leaves them out.</source>
        <translation>{missing} 棟の建物にモデルがなく、メッシュ内の位置もありません。CityGMLでは除かれます。</translation>
    </message>
    <message>
        <source>3D Tiles have no place for installations and rooms of buildings: {count} are left out.</source>
        <translation>3D Tiles には建物の付属物と部屋を入れる場所がないため、{count} 個を省きました。</translation>
    </message>
    <message>
        <source>{source} holds no {module}/{version}/{name}: give the folder of i-UR's schemas.</source>
        <translation>{source} に {module}/{version}/{name} がありません。i-UR のスキーマのフォルダを指定してください。</translation>
    </message>
    <message>
        <source>3D Tiles want heights above the ellipsoid, but the models do not state what theirs count from, and they are written as they are: give a geoid model, or buildings sink or float on a globe.</source>
        <translation>3D Tilesの高さは楕円体高ですが、モデルに高さの基準が示されていないため、高さをそのまま書き出します。ジオイドモデルを指定してください。指定しないと、地球上で建物が沈んだり浮いたりします。</translation>
    </message>
    <message>
        <source>3D Tiles want heights above the ellipsoid, but those of the models are in {heights} and are written as they are: give a geoid model, or buildings sink or float on a globe.</source>
        <translation>3D Tilesの高さは楕円体高ですが、モデルの高さは{heights}で、そのまま書き出されます。ジオイドモデルを指定してください。指定しないと、地球上で建物が沈んだり浮いたりします。</translation>
    </message>
    <message>
        <source>The file {place} cannot be written ({strerror}).</source>
        <translation>ファイル {place} に書き込めません（{strerror}）。</translation>
    </message>
    <message>
        <source>East and north of the city model are exchanged: as its reference system orders them, its first building lies at east {east} m, north {north} m, and only the other way round where the system is used. Export the model with the coordinates in the order of its reference system, or name the system in its short form (EPSG:31467), which counts east first.</source>
        <translation>都市モデルの東方向と北方向の座標が入れ替わっています。座標参照系の順序どおりに読むと、最初の建築物は東{east} m、北{north} mになり、逆に読んだ場合にだけ座標参照系の使用範囲に入ります。座標参照系の順序どおりの座標でモデルを出力し直すか、座標参照系を東方向が先になる短い形式（EPSG:31467）で記載してください。</translation>
    </message>
    <message>
        <source>The city models are in different reference systems: load them in separate runs.</source>
        <translation>都市モデルの座標参照系が異なります。別々に実行して読み込んでください。</translation>
    </message>
    <message>
        <source>The city model holds no building: give one that has buildings.</source>
        <translation>都市モデルに建物がありません。建物のある都市モデルを指定してください。</translation>
    </message>
    <message>
        <source>The city model was taken into another datum by {told}.</source>
        <translation>都市モデルを {told} により別の測地系に変換しました。</translation>
    </message>
    <message>
        <source>Latitude and longitude of the city model are exchanged: as its reference system orders degrees, its first building lies at latitude {latitude}, longitude {longitude}, and only the other way round where the system is used. Export the model with the degrees in the order of its reference system.</source>
        <translation>都市モデルの緯度と経度が入れ替わっています。座標参照系の順序どおりに読むと、最初の建築物は緯度{latitude}、経度{longitude}になり、逆に読んだ場合にだけ座標参照系の使用範囲に入ります。座標参照系の順序どおりの緯度・経度でモデルを出力し直してください。</translation>
    </message>
    <message>
        <source>The city model is in degrees outside of Japan: choose a projected coordinate reference system in metres for the result.</source>
        <translation>都市モデルが日本の外にあり、度単位です。結果にはメートル単位の投影座標参照系を選択してください。</translation>
    </message>
    <message>
        <source>No building of the city model has a geometry: give one with outlines or solids.</source>
        <translation>都市モデルにジオメトリをもつ建物がありません。外周線または立体のある都市モデルを指定してください。</translation>
    </message>
    <message>
        <source>The folder {place} cannot be made ({strerror}): choose another output.</source>
        <translation>フォルダ {place} を作成できません（{strerror}）。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>The code {code} is none of a municipality: give its five digits, such as 13101.</source>
        <translation>コード {code} の市区町村はありません。13101のような5桁で指定してください。</translation>
    </message>
    <message>
        <source>give the files of what is asked for ({folders} of PLATEAU)</source>
        <translation>求めるもののファイル（PLATEAU の {folders}）を指定してください</translation>
    </message>
    <message>
        <source>it has no id</source>
        <translation>IDがありません</translation>
    </message>
    <message>
        <source>{source} names no coordinate reference system: give the one that it is in.</source>
        <translation>{source} に座標参照系の記載がありません。データの座標参照系を指定してください。</translation>
    </message>
    <message>
        <source>{source} is no CityGML (its root is {split_tag}): give a city model.</source>
        <translation>{source} はCityGMLではありません（ルートが {split_tag}）。都市モデルを指定してください。</translation>
    </message>
    <message>
        <source>{source} is CityGML 3.0, whose buildings are not read yet: give CityGML 2.0 or 1.0.</source>
        <translation>{source} は CityGML 3.0 です。その建築物はまだ読み込めません。CityGML 2.0 または 1.0 を指定してください。</translation>
    </message>
    <message>
        <source>{source} is in another reference system than {sources}: load them in separate runs.</source>
        <translation>{source} の座標参照系が {sources} と異なります。別々に実行して読み込んでください。</translation>
    </message>
    <message>
        <source>its surfaces are nested too deep</source>
        <translation>面の入れ子が深すぎます</translation>
    </message>
    <message>
        <source>the texture of polygon {identifier} does not fit its corners and was left out</source>
        <translation>ポリゴン {identifier} のテクスチャが頂点に合わないため除きました</translation>
    </message>
    <message>
        <source>its solid of level {lod} has no usable face</source>
        <translation>レベル {lod} の立体に使える面がありません</translation>
    </message>
    <message>
        <source>its solid of level {lod} is not closed ({gaps} edges without a neighbour)</source>
        <translation>レベル {lod} の立体が閉じていません（隣のない辺 {gaps}）</translation>
    </message>
    <message>
        <source>it refers to the surface {reference}, which it does not have</source>
        <translation>存在しない面 {reference} を参照しています</translation>
    </message>
    <message>
        <source>{count} buildings have parts that lie apart and no LOD1: it is one solid for the whole building, and parts have none.</source>
        <translation>{count} 棟は部分が離れているため LOD1 がありません。LOD1 は建築物全体で一つの立体とし、建築物部分はもちません。</translation>
    </message>
    <message>
        <source>{count} attributes have no place in i-UR {version} and are written as generic ones ({names}).</source>
        <translation>i-UR {version} に該当のない属性が {count} 個あり、汎用属性として出力しました（{names}）。</translation>
    </message>
    <message>
        <source>The folder {folder} holds CityGML of an earlier run, which stays ({count} files: {names}): delete it, if it does not belong to this delivery.</source>
        <translation>フォルダー {folder} には以前の実行の CityGML が残っています ({count} ファイル: {names})。今回の成果に属さない場合は削除してください。</translation>
    </message>
    <message>
        <source>{count} lists of codes that the models refer to were not beside them ({names}): copy them into the folder codelists, where PLATEAU wants all lists that are referred to.</source>
        <translation>モデルが参照するコードリスト {count} 件がモデルとともにありませんでした（{names}）。参照するすべてのコードリストが必要ですので（PLATEAU）、codelists フォルダにコピーしてください。</translation>
    </message>
    <message>
        <source>The folder {target} cannot be made ({strerror}): choose another output.</source>
        <translation>フォルダ {target} を作成できません（{strerror}）。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>The folder {folder} holds CityGML of another program ({path}): choose another folder.</source>
        <translation>フォルダ {folder} に別のプログラムのCityGML（{path}）があります。別のフォルダを選択してください。</translation>
    </message>
    <message>
        <source>{path} is not a CityJSON file: its type is not 'CityJSON'.</source>
        <translation>{path} はCityJSONファイルではありません。typeが 'CityJSON' ではありません。</translation>
    </message>
    <message>
        <source>{path} is damaged: its line {number} is no object; export it again.</source>
        <translation>{path} は破損しています。{number} 行目がオブジェクトではありません。再度出力してください。</translation>
    </message>
    <message>
        <source>{path} is damaged: its vertex {bad} has no finite coordinates.</source>
        <translation>{path} は破損しています。頂点 {bad} の座標が有限ではありません。</translation>
    </message>
    <message>
        <source>{path} is damaged: its line {number} is no JSON; export it again.</source>
        <translation>{path} は破損しています。{number} 行目がJSONではありません。再度出力してください。</translation>
    </message>
    <message>
        <source>{path} names no coordinate reference system: give the one that it is in.</source>
        <translation>{path} に座標参照系の記載がありません。データの座標参照系を指定してください。</translation>
    </message>
    <message>
        <source>{path} is damaged: it has no city objects or no vertices; export it again.</source>
        <translation>{path} は壊れています。都市オブジェクトまたは頂点がありません。もう一度出力してください。</translation>
    </message>
    <message>
        <source>{path} is damaged: an attribute of {key} is no finite number.</source>
        <translation>{path}が破損しています。{key}の属性が有限の数値ではありません。</translation>
    </message>
    <message>
        <source>{path} is damaged: a ring of {key} is no list of vertices; export it again.</source>
        <translation>{path} は壊れています。{key} のリングが頂点のリストになっていません。出力し直してください。</translation>
    </message>
    <message>
        <source>{path} is damaged: {key} names a vertex that is not there; export it again.</source>
        <translation>{path} は壊れています。{key} が存在しない頂点を指しています。出力し直してください。</translation>
    </message>
    <message>
        <source>{path} is damaged: its vertex {bad} is no list of three numbers; export it again.</source>
        <translation>{path} は壊れています。頂点 {bad} が三つの数のリストになっていません。出力し直してください。</translation>
    </message>
    <message>
        <source>{path} is damaged: the scale of its “transform” is 0, so that all corners lie at one place; export it again.</source>
        <translation>{path} は壊れています。“transform” の scale が 0 で、すべての頂点が 1 か所に重なります。もう一度書き出してください。</translation>
    </message>
    <message>
        <source>its part {child} is not there</source>
        <translation>部分 {child} がありません</translation>
    </message>
    <message>
        <source>a face has fewer than three corners</source>
        <translation>頂点が3点未満の面があります</translation>
    </message>
    <message>
        <source>its part {child} has parts of its own, which were left out</source>
        <translation>部分 {child} がさらに部分をもつため、それらを除きました</translation>
    </message>
    <message>
        <source>{path} has no textures: give the CityJSON file that “Facade textures” wrote.</source>
        <translation>{path} にテクスチャがありません。「壁面テクスチャ」で出力したCityJSONファイルを指定してください。</translation>
    </message>
    <message>
        <source>{path} names the image {name}, which is not in its own folder: move it there.</source>
        <translation>{path} が参照する画像 {name} が同じフォルダにありません。そこに移動してください。</translation>
    </message>
    <message>
        <source>CityJSON is written in metres, but the model counts in degrees: take it into a plane reference system first.</source>
        <translation>CityJSONはメートルで書き出しますが、モデルは度単位です。先に平面直角座標系などの平面の座標系に変換してください。</translation>
    </message>
    <message>
        <source>The model file {path} needs a name that ends in .glb.</source>
        <translation>モデルファイル{path}の拡張子は .glb にしてください。</translation>
    </message>
    <message>
        <source>The image {look} of a texture was not given: its file is missing.</source>
        <translation>テクスチャの画像 {look} がありません。そのファイルが見つかりません。</translation>
    </message>
    <message>
        <source>{lost_count} images of textures are not there ({lost}): their faces are written without.</source>
        <translation>テクスチャ画像 {lost_count} 枚が見つかりません（{lost}）。該当する面はテクスチャなしで書き出されます。</translation>
    </message>
    <message>
        <source>The image {path} of a texture is a TIFF that cannot be read: save it as PNG or JPEG.</source>
        <translation>テクスチャの画像 {path} は読み取れない TIFF です。PNG 又は JPEG で保存してください。</translation>
    </message>
    <message>
        <source>The image {image} of a texture was not given: its file is missing.</source>
        <translation>テクスチャの画像 {image} がありません。そのファイルが見つかりません。</translation>
    </message>
    <message>
        <source>The image {place} cannot be written ({strerror}).</source>
        <translation>画像 {place} に書き込めません（{strerror}）。</translation>
    </message>
    <message>
        <source>A surface of the model has coordinates that are no numbers, as a file without heights has them (a Shapefile of buildings, for example): give the models as they were made.</source>
        <translation>モデルの面に数値でない座標があります（建物のシェープファイルなど、高さのないファイル）。作成されたままのモデルを指定してください。</translation>
    </message>
    <message>
        <source>{where}: the coordinate reference system {name} is not known; give the one that it is in.</source>
        <translation>{where}: 座標参照系 {name} は不明です。データの座標参照系を指定してください。</translation>
    </message>
    <message>
        <source>The coordinate reference system has no horizontal part: choose another.</source>
        <translation>座標参照系に水平成分がありません。別の座標参照系を選択してください。</translation>
    </message>
    <message>
        <source>{where}: the coordinate reference system EPSG:{code} is not known here; give the one that it is in.</source>
        <translation>{where}: 座標参照系EPSG:{code} はここでは不明です。データの座標参照系を指定してください。</translation>
    </message>
    <message>
        <source>The mesh file {target} needs a name that ends in .obj.</source>
        <translation>メッシュファイル{target}の拡張子は .obj にしてください。</translation>
    </message>
    <message>
        <source>'{id}' has corners where its reference system cannot be computed: check the system, and the corners by “Check city model or lane map”.</source>
        <translation>「{id}」に参照系で計算できない頂点があります。参照系を確認し、頂点は「3D都市モデル・車線地図の検査」で調べてください。</translation>
    </message>
    <message>
        <source>Two buildings have the id '{id}': give each building its own.</source>
        <translation>2つの建物のidが同じ '{id}' です。建物ごとに異なるidを付けてください。</translation>
    </message>
    <message>
        <source>City objects that are no buildings were passed over ({counts}).</source>
        <translation>建物以外の都市オブジェクトは読み飛ばしました（{counts}）。</translation>
    </message>
    <message>
        <source>Parts of buildings that have no place in the result were left out ({counts}).</source>
        <translation>結果に入れられない建物の部分を除きました（{counts}）。</translation>
    </message>
    <message>
        <source>{missing_lists_count} lists of codes are not there or damaged, so that codes stay as they are ({missing_lists}).</source>
        <translation>コードリスト {missing_lists_count} 件がないか壊れているため、コードはそのままです（{missing_lists}）。</translation>
    </message>
    <message>
        <source>{missing_images_count} images of textures are not there, not in the model's folder, or no PNG, JPEG or TIFF ({missing_images}); their faces have none.</source>
        <translation>テクスチャ画像 {missing_images_count} 枚が見つからないか、モデルのフォルダー外にあるか、PNG・JPEG・TIFF ではありません（{missing_images}）。該当する面はテクスチャなしになります。</translation>
    </message>
    <message>
        <source>{repeated_count} ids are there more than once and got a number behind ({repeated}).</source>
        <translation>重複するID {repeated_count} 件の後ろに番号を付けました（{repeated}）。</translation>
    </message>
    <message>
        <source>The models state heights in {stated}, not in {given}: convert them first, or leave the height system out.</source>
        <translation>モデルの高さの基準は {stated} で、{given} ではありません。先に変換するか、高さの基準を指定しないでください。</translation>
    </message>
    <message>
        <source>{path} is of another format than the output: choose CityJSON for CityJSON, and a folder of CityGML for CityGML; “Export city model” converts.</source>
        <translation>{path} は出力と形式が異なります。CityJSONにはCityJSON、CityGMLのフォルダにはCityGMLを選んでください。変換には「都市モデルの書出し」を使います。</translation>
    </message>
    <message>
        <source>{path} cannot be updated: it is damaged, or no city model of this format.</source>
        <translation>{path} を更新できません。破損しているか、この形式の都市モデルではありません。</translation>
    </message>
    <message>
        <source>{path} is no sound XML ({error}): copy or download it again.</source>
        <translation>{path} は正しいXMLではありません（{error}）。コピーまたはダウンロードし直してください。</translation>
    </message>
    <message>
        <source>The model is in another reference system ({model}) than what is put into it ({changed}).</source>
        <translation>モデルの座標参照系（{model}）が、挿入するもの（{changed}）と異なります。</translation>
    </message>
    <message>
        <source>it has no outline and no face from which one could be made</source>
        <translation>外周線も、それを作れる面もありません</translation>
    </message>
    <message>
        <source>its measured height “{text}” is no number</source>
        <translation>計測高さ「{text}」が数値ではありません</translation>
    </message>
    <message>
        <source>its corners lie {extent} km apart, so that a coordinate is wrong</source>
        <translation>頂点が {extent} km 離れており、座標値に誤りがあります</translation>
    </message>
    <message>
        <source>it has no surface that could be read</source>
        <translation>読み取れる面がありません</translation>
    </message>
    <message>
        <source>The temporary file {path} is cut off: make room on the disk of temporary files, and run again.</source>
        <translation>一時ファイル {path} が途中で切れています。一時ファイルのディスクに空きを作り、もう一度実行してください。</translation>
    </message>
    <message>
        <source>The folder {folder} holds a tileset of another program: choose another folder.</source>
        <translation>フォルダ {folder} に別のプログラムのタイルセットがあります。別のフォルダを選択してください。</translation>
    </message>
    <message>
        <source>3D Tiles need a place on the earth: the models' coordinate reference system is not known.</source>
        <translation>3D Tilesには地球上の位置が必要ですが、モデルの座標参照系が不明です。</translation>
    </message>
    <message>
        <source>Python packages missing: {names}. Install them with the menu Plugins &gt; UrbanMap &gt; Install Python packages, or in a terminal with: {command}</source>
        <translation>Python パッケージがありません：{names}。メニュー「プラグイン &gt; UrbanMap &gt; Python パッケージのインストール」か、端末で次のコマンドによりインストールしてください：{command}</translation>
    </message>
    <message>
        <source>Python packages in the way: {names}.</source>
        <translation>Python パッケージが競合しています：{names}。</translation>
    </message>
    <message>
        <source>install it with: sudo apt install python3-pip</source>
        <translation>次のコマンドでインストールしてください：sudo apt install python3-pip</translation>
    </message>
    <message>
        <source>install it with: {shown_command}</source>
        <translation>次のコマンドでインストールしてください：{shown_command}</translation>
    </message>
    <message>
        <source>{python} has no pip, which installs Python packages: {advice}</source>
        <translation>{python} には、Pythonパッケージをインストールするpipがありません: {advice}</translation>
    </message>
    <message>
        <source>{requirement} (installed, but {found_version} was loaded before from {in_the_way}: restart QGIS, without the plugin that loads it)</source>
        <translation>{requirement}（インストール済みですが、先に {in_the_way} から {found_version} が読み込まれています。それを読み込むプラグインを外してQGISを再起動してください）</translation>
    </message>
    <message>
        <source>{requirement} (found {found_version})</source>
        <translation>{requirement}（現在 {found_version}）</translation>
    </message>
    <message>
        <source>pip could not install the packages: {value}</source>
        <translation>pipがパッケージをインストールできませんでした: {value}</translation>
    </message>
    <message>
        <source>Python cannot be started as {command} ({strerror}).</source>
        <translation>Pythonを {command} として起動できません（{strerror}）。</translation>
    </message>
    <message>
        <source>it gave no reason</source>
        <translation>理由は示されませんでした</translation>
    </message>
    <message>
        <source>a fault of the program, which its log tells; please report it</source>
        <translation>プログラムの不具合です。内容はログにあります。報告をお願いします</translation>
    </message>
    <message>
        <source>the memory was not enough for it</source>
        <translation>この建物の処理にはメモリが足りませんでした</translation>
    </message>
    <message>
        <source>The memory is not enough for this run: give less data at a time, or a coarser resolution.</source>
        <translation>この処理にはメモリが不足しています。一度に与えるデータを減らすか、解像度を粗くしてください。</translation>
    </message>
    <message>
        <source>The disk is full: make room on the disk of the outputs and of temporary files, and run again.</source>
        <translation>ディスクの空き容量がありません。出力先と一時ファイルのディスクを空けて、再度実行してください。</translation>
    </message>
    <message>
        <source>Matrix is not positive definite</source>
        <translation>行列が正定値ではありません</translation>
    </message>
    <message>
        <source>The trajectory runs from {first:.0f} to {last:.0f} s, but the points were measured from {start:.0f} to {end:.0f} s: give the trajectory of this survey, in the time of its points.</source>
        <translation>軌跡の時刻は {first:.0f}～{last:.0f} 秒ですが、点群は {start:.0f}～{end:.0f} 秒に計測されています。この計測の軌跡を、点群と同じ時刻系で指定してください。</translation>
    </message>
    <message>
        <source>The trajectory lies {distance:.0f} m from what was measured at its times: check that it is in the coordinate reference system of the points.</source>
        <translation>軌跡は、同じ時刻に計測された点から {distance:.0f} m 離れています。軌跡が点と同じ座標参照系であるか確認してください。</translation>
    </message>
    <message>
        <source>The trajectory runs from {first:.0f} to {last:.0f} s, but no point near a building was measured then: give the trajectory of this survey, in the time of its points.</source>
        <translation>軌跡の時刻は {first:.0f}～{last:.0f} 秒ですが、その間に計測された建物付近の点がありません。この計測の軌跡を、点と同じ時刻系で指定してください。</translation>
    </message>
    <message>
        <source>The trajectory lies {height:.0f} m above the ground beside the buildings: check its heights (give GEOID where they are ellipsoidal); what hides walls is wrong else.</source>
        <translation>軌跡は建物脇の地盤から {height:.0f} m の高さにあります。高さを確認してください（楕円体高の場合は GEOID を指定）。そのままでは壁面を隠す物の判定が誤ります。</translation>
    </message>
    <message>
        <source>Round {count} buildings some points were measured when no trajectory tells a pose: what hides their walls may be counted as unseen.</source>
        <translation>{count} 棟の周囲では、軌跡に位置のない時刻に計測された点があります。壁面を隠す物が「未計測」に数えられることがあります。</translation>
    </message>
    <message>
        <source>No building has a polygon: choose a layer of outlines or building models.</source>
        <translation>ポリゴンをもつ建物がありません。建物外周線または建物モデルのレイヤを選択してください。</translation>
    </message>
    <message>
        <source>No point of the survey lies near a building: check that both are of the same place and CRS, and that the survey has been put on the map.</source>
        <translation>建物の近くにMMS計測の点がありません。両者の場所とCRSが同じで、MMS計測が地図に位置合わせされているか確認してください。</translation>
    </message>
    <message>
        <source>canopy</source>
        <translation>庇</translation>
    </message>
    <message>
        <source>sign band</source>
        <translation>看板</translation>
    </message>
    <message>
        <source>balcony</source>
        <translation>バルコニー</translation>
    </message>
    <message>
        <source>garden wall</source>
        <translation>塀</translation>
    </message>
    <message>
        <source>hoarding</source>
        <translation>仮囲い</translation>
    </message>
    <message>
        <source>post</source>
        <translation>柱</translation>
    </message>
    <message>
        <source>setback</source>
        <translation>セットバック</translation>
    </message>
    <message>
        <source>recess</source>
        <translation>後退した1階</translation>
    </message>
    <message>
        <source>unclear</source>
        <translation>不明</translation>
    </message>
    <message>
        <source>the survey did not see the rest</source>
        <translation>残りは計測されていません</translation>
    </message>
    <message>
        <source>{kind}, {before:.1f} m before the facade</source>
        <translation>{kind}：壁面の {before:.1f} m 手前</translation>
    </message>
    <message>
        <source>beams went through most of the rest: glass, or openings</source>
        <translation>残りの大部分はビームが通り抜けています：ガラスまたは開口部</translation>
    </message>
    <message>
        <source>something stands in front</source>
        <translation>手前に物があります</translation>
    </message>
    <message>
        <source>a wall at another depth may be the facade as well: a hoarding, or a storey that stands back</source>
        <translation>別の奥行きの壁面が建物の壁面である可能性もあります：仮囲い、またはセットバックした階</translation>
    </message>
    <message>
        <source>only {points} points lie on it</source>
        <translation>点が {points} 点しかありません</translation>
    </message>
    <message>
        <source>its points scatter by {rmse:.0f} cm: no flat wall, or drives that disagree</source>
        <translation>点のばらつきが {rmse:.0f} cm あります：平らな壁でないか、走行間で一致していません</translation>
    </message>
    <message>
        <source>it lies {depth:.1f} m inside the outline: a setback, or a room seen through a window</source>
        <translation>外周線の {depth:.1f} m 内側にあります：セットバック、または窓越しの室内</translation>
    </message>
    <message>
        <source>{coverage:.0f} % of it was seen; {why}</source>
        <translation>{coverage:.0f} % が計測されました；{why}</translation>
    </message>
    <message>
        <source>Building {ids}: only {kept_share:.0f} % of its points were used, as there are more than fit into memory.</source>
        <translation>建物 {ids}: 点がメモリに収まらないため、{kept_share:.0f} %の点だけを用いました。</translation>
    </message>
    <message>
        <source>An alpha shape needs points with two coordinates.</source>
        <translation>アルファシェイプには2つの座標をもつ点が必要です。</translation>
    </message>
    <message>
        <source>Alpha must be above zero metres.</source>
        <translation>アルファは0 mより大きくしてください。</translation>
    </message>
    <message>
        <source>The raster's extent or cell size is not a number: check the coordinates.</source>
        <translation>ラスタの範囲またはセルサイズが数値ではありません。座標を確認してください。</translation>
    </message>
    <message>
        <source>The place {latitude:.5f}, {longitude:.5f} has no mesh code: it is not in Japan.</source>
        <translation>位置 {latitude:.5f}, {longitude:.5f} にはメッシュコードがありません。日本の外です。</translation>
    </message>
    <message>
        <source>The map</source>
        <translation>地図</translation>
    </message>
    <message>
        <source>The trajectory lies outside the area of its CRS: check the CRS.</source>
        <translation>軌跡がそのCRSの範囲外にあります。CRSを確認してください。</translation>
    </message>
    <message>
        <source>No navigation file is given: give the satellites' navigation files of the day.</source>
        <translation>航法ファイルが指定されていません。当日の衛星の航法ファイルを指定してください。</translation>
    </message>
    <message>
        <source>{name} is not an SP3 file of version c or d: check the file.</source>
        <translation>{name} はバージョンcまたはdのSP3ファイルではありません。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{name} counts time in "{scale}", which is not known: use orbits in GPS time.</source>
        <translation>{name} の時刻系 "{scale}" は不明です。GPS時の軌道情報を用いてください。</translation>
    </message>
    <message>
        <source>{name}: {where} is not finite; download the file again.</source>
        <translation>{name}: {where}が有限の値ではありません。ファイルを再度ダウンロードしてください。</translation>
    </message>
    <message>
        <source>{name} holds no satellite position: the file is not whole.</source>
        <translation>{name}に衛星位置がありません。ファイルが不完全です。</translation>
    </message>
    <message>
        <source>line {number}</source>
        <translation>{number} 行目</translation>
    </message>
    <message>
        <source>There is no observation to trace: check that observations, ephemerides and trajectory belong to the same time and place.</source>
        <translation>追跡できる観測値がありません。観測データ、衛星暦、軌跡が同じ時刻・場所のものか確認してください。</translation>
    </message>
    <message>
        <source>All places of the antenna lie within buildings: check the coordinate systems and heights of the trajectory and of the buildings.</source>
        <translation>アンテナの位置がすべて建物の内部にあります。軌跡と建物の座標参照系および高さを確認してください。</translation>
    </message>
    <message>
        <source>At {sum} of {indoors_count} epochs the antenna lies within a building: their signals are left out.</source>
        <translation>{indoors_count} エポックのうち {sum} エポックでアンテナが建物の内部にあるため、その信号を除外します。</translation>
    </message>
    <message>
        <source>No cell of the area has a ground height: give a ground that covers it.</source>
        <translation>範囲内に地表の高さがあるセルがありません。範囲を覆う地表面を指定してください。</translation>
    </message>
    <message>
        <source>The whole area lies inside buildings: choose a larger area or finer cells.</source>
        <translation>範囲全体が建物の内部にあります。範囲を広げるか、セルを細かくしてください。</translation>
    </message>
    <message>
        <source>The buildings do not tell the height of the ground: give a ground raster.</source>
        <translation>建物からは地表の高さが分かりません。地表面のラスタを指定してください。</translation>
    </message>
    <message>
        <source>No satellite of the chosen systems ({chosen}) can be placed at {calendar_text} GPS time; the navigation files are good for {spans_text}: give those of the day.</source>
        <translation>GPS時刻 {calendar_text} に、選択した衛星系（{chosen}）の衛星位置を計算できません。航法ファイルの有効期間は{spans_text}です。該当日のファイルを指定してください。</translation>
    </message>
    <message>
        <source>The area has {cells:.1f} million cells of {resolution:g} m: choose a coarser resolution or a smaller area.</source>
        <translation>範囲のセル数が {resolution:g} m セルで {cells:.1f} 百万になります。解像度を粗くするか、範囲を小さくしてください。</translation>
    </message>
    <message>
        <source>"{text}" is no time: write it as 2024-04-18 02:30:00, in UTC.</source>
        <translation>「{text}」は時刻として読めません。UTCで 2024-04-18 02:30:00 のように記述してください。</translation>
    </message>
    <message>
        <source>{without} of {shapes_count} buildings have no heights: give solids, outlines with z, or the field with the height of their tops.</source>
        <translation>{shapes_count} 棟のうち {without} 棟に高さがありません。立体、z値付きの外周線、または上端の高さのフィールドを指定してください。</translation>
    </message>
    <message>
        <source>The buildings have no walls: give solids or outlines with heights.</source>
        <translation>建物に壁面がありません。立体、または高さ付きの外周線を指定してください。</translation>
    </message>
    <message>
        <source>measured, m</source>
        <translation>観測 (m)</translation>
    </message>
    <message>
        <source>(moves: {third:.1f} m)</source>
        <translation>（移動量では {third:.1f} m）</translation>
    </message>
    <message>
        <source>in line of sight</source>
        <translation>見通し内</translation>
    </message>
    <message>
        <source>blocked, no single wall reflects it</source>
        <translation>遮蔽、単一の壁面による反射なし</translation>
    </message>
    <message>
        <source>reflected by one wall</source>
        <translation>1つの壁面で反射</translation>
    </message>
    <message>
        <source>Where measured and predicted paths agree below, the models can be adjusted by them.</source>
        <translation>下の図で観測と予測の経路が一致していれば、それによりモデルを調整できます。</translation>
    </message>
    <message>
        <source>{sum} of {adjusted_count} walls are adjusted, with a median standard deviation of {median:.2f} m, {likely} more are likely ({likely_median:.2f} m). The others stay where they were: nothing is known of them.</source>
        <translation>{adjusted_count}枚の壁のうち{sum}枚を調整しました（標準偏差の中央値{median:.2f} m）。ほかに{likely}枚は推定です（{likely_median:.2f} m）。残りは元の位置のままで、位置は分かりません。</translation>
    </message>
    <message>
        <source>{order_count} more are in the layer of walls.</source>
        <translation>残り {order_count} 件は壁面レイヤにあります。</translation>
    </message>
    <message>
        <source>The geoid separation was estimated from the satellites ({geoid_separation:.1f} m, sigma {geoid_sigma:.1f} m). An error of it is mostly taken up by the clock.</source>
        <translation>ジオイド高は衛星から推定しました（{geoid_separation:.1f} m、σ {geoid_sigma:.1f} m）。その誤差の大部分は時計誤差に吸収されます。</translation>
    </message>
    <message>
        <source>{count} of {kind_count} signals are reflected by one wall; of {sure:.0f} % of all signals the class is sure.</source>
        <translation>{kind_count} 信号のうち {count} 信号が1つの壁面で反射しています。全信号の {sure:.0f} % は分類が確実です。</translation>
    </message>
    <message>
        <source>Residuals of signals {names} ({sum:,}).</source>
        <translation>信号の残差: {names}（{sum:,}）</translation>
    </message>
    <message>
        <source>line {row} does not name its satellites</source>
        <translation>{row}行目に衛星名がありません</translation>
    </message>
    <message>
        <source>line {row} changes a number that was not given</source>
        <translation>{row}行目が、初期値のない数値を更新しています</translation>
    </message>
    <message>
        <source>line {row} is of a system whose types are not in the header</source>
        <translation>{row}行目の衛星系の観測種別がヘッダにありません</translation>
    </message>
    <message>
        <source>its version is {version}</source>
        <translation>バージョンが{version}です</translation>
    </message>
    <message>
        <source>{name} is damaged compact (Hatanaka) RINEX ({error}): fetch it again, or give plain RINEX.</source>
        <translation>{name}は破損した圧縮（Hatanaka）RINEXです（{error}）。再度取得するか、通常のRINEXを指定してください。</translation>
    </message>
    <message>
        <source>{file} holds observations: give a navigation file here.</source>
        <translation>{file}は観測ファイルです。ここには航法ファイルを指定してください。</translation>
    </message>
    <message>
        <source>{file} is a RINEX file but no navigation file: give one of type N.</source>
        <translation>{file}はRINEXファイルですが、航法ファイルではありません。種別Nのファイルを指定してください。</translation>
    </message>
    <message>
        <source>{file} holds no record of a satellite that can be used: give another navigation file.</source>
        <translation>{file}に使用できる衛星の記録がありません。別の航法ファイルを指定してください。</translation>
    </message>
    <message>
        <source>{file}: {broken} records of satellites are not whole and are left out.</source>
        <translation>{file}：不完全な衛星の記録 {broken} 件を除きました。</translation>
    </message>
    <message>
        <source>{file} is a RINEX file but holds no observations: give it as another parameter.</source>
        <translation>{file}はRINEXファイルですが、観測データを含みません。別のパラメータに指定してください。</translation>
    </message>
    <message>
        <source>{file}: {unread} numbers cannot be read and are left out.</source>
        <translation>{file}：読めない数値 {unread} 件を除きました。</translation>
    </message>
    <message>
        <source>{file} counts time in "{scale}", which is not known: convert it to GPS time.</source>
        <translation>{file}の時系「{scale}」は未対応です。GPS時刻に変換してください。</translation>
    </message>
    <message>
        <source>{name}: {kept_count} observations are there twice and are used once.</source>
        <translation>{name}：重複する観測 {kept_count} 件は一度だけ使います。</translation>
    </message>
    <message>
        <source>{file} does not tell its types of observations: its header is not whole.</source>
        <translation>{file}に観測種別の記載がありません。ヘッダが不完全です。</translation>
    </message>
    <message>
        <source>{file}: {count} of {total} observations of system {system} are left out: their codes (of {kinds}) are on no band whose group delay the navigation messages tell (bands {bands}).</source>
        <translation>{file}：衛星系 {system} の観測値 {total} 個のうち {count} 個を使いません。コード（{kinds}）が、航法メッセージで群遅延が分かる周波数帯（{bands}）にないためです。</translation>
    </message>
    <message>
        <source>{file} holds no epoch with observations: check the file.</source>
        <translation>{file}に観測値のあるエポックがありません。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{name}: {short} epochs are not whole and are used as far as they go.</source>
        <translation>{name}：不完全なエポック {short} 件は、使えるところまで使います。</translation>
    </message>
    <message>
        <source>{name}: {skipped} lines fit in no epoch and are left out.</source>
        <translation>{name}：どのエポックにも合わない {skipped} 行を除きました。</translation>
    </message>
    <message>
        <source>{name} is made of several files: {left_out} lines behind a header with another version, kind, time or scale are left out; give its parts as files of their own.</source>
        <translation>{name} は複数のファイルをつないだものです。版・種類・時刻系・倍率の異なるヘッダーより後の {left_out} 行は使いません。元のファイルに分けて指定してください。</translation>
    </message>
    <message>
        <source>{file} holds no code observation of the chosen systems: check the file.</source>
        <translation>{file}に、選択した衛星系のコード観測値がありません。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{file} has a scale factor that cannot be read: check its header.</source>
        <translation>{file}のスケールファクタを読み取れません。ヘッダを確認してください。</translation>
    </message>
    <message>
        <source>{name} holds more than {largest} MB when unpacked: give the files of one drive at a time.</source>
        <translation>{name}は展開すると {largest} MB を超えます。1走行分ずつファイルを指定してください。</translation>
    </message>
    <message>
        <source>{path} is packed in a way that is not read here: unpack it, or pack it with gzip.</source>
        <translation>{path}は未対応の形式で圧縮されています。展開するか、gzipで圧縮してください。</translation>
    </message>
    <message>
        <source>{path} is empty: choose another file.</source>
        <translation>{path}は空です。別のファイルを選択してください。</translation>
    </message>
    <message>
        <source>{name} is not a RINEX file: its first line does not say "RINEX VERSION / TYPE".</source>
        <translation>{name}はRINEXファイルではありません。1行目に「RINEX VERSION / TYPE」がありません。</translation>
    </message>
    <message>
        <source>{name} is RINEX {version:.2f}: convert it to RINEX 2.11, 3 or 4.</source>
        <translation>{name}はRINEX {version:.2f}です。RINEX 2.11、3または4に変換してください。</translation>
    </message>
    <message>
        <source>{name} has no "END OF HEADER": the file is not whole.</source>
        <translation>{name}に「END OF HEADER」がありません。ファイルが不完全です。</translation>
    </message>
    <message>
        <source>{path} cannot be read ({strerror}): check the file.</source>
        <translation>{path}を読み込めません（{strerror}）。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{path} breaks off: it is used up to there.</source>
        <translation>{path} は途中で切れています。そこまでを使います。</translation>
    </message>
    <message>
        <source>{name} tells no RINEX version in its first line: check the file.</source>
        <translation>{name}の1行目にRINEXのバージョンがありません。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{name} is not a sound bzip2 file: fetch it again.</source>
        <translation>{name}は正しいbzip2ファイルではありません。再度取得してください。</translation>
    </message>
    <message>
        <source>{name} is not a sound gzip file: fetch it again.</source>
        <translation>{name}は正常なgzipファイルではありません。再度取得してください。</translation>
    </message>
    <message>
        <source>Too few satellites at different elevations tell the height of the antenna: give the geoid separation.</source>
        <translation>仰角の異なる衛星が少なく、アンテナの高さを決定できません。ジオイド高を指定してください。</translation>
    </message>
    <message>
        <source>{first:.0f} to {last:.0f} s of week</source>
        <translation>週の {first:.0f}～{last:.0f} 秒</translation>
    </message>
    <message>
        <source>Trajectory and {what} are not of one time: the trajectory covers {told}, the {what} cover {span_text} GPS time ({start:.0f} to {end:.0f} s of week).</source>
        <translation>軌跡と{what}の時刻が一致しません。軌跡は{told}、{what}はGPS時刻で{span_text}（週内秒 {start:.0f}～{end:.0f} s）です。</translation>
    </message>
    <message>
        <source>outside the trajectory or in a gap of it</source>
        <translation>軌跡の範囲外、または軌跡の欠測中</translation>
    </message>
    <message>
        <source>weaker than {min_cn0:g} dB-Hz</source>
        <translation>{min_cn0:g} dB-Hz より弱い</translation>
    </message>
    <message>
        <source>The ionosphere is measured on two bands in {count} of {files} observation files: {vertical:.1f} m at the zenith (sigma {sigma:.1f} m) where the broadcast model says {modelled:.1f} m.</source>
        <translation>電離層遅延は、{files} 個の観測ファイルのうち {count} 個で2周波から測定しました。天頂方向 {vertical:.1f} m（σ {sigma:.1f} m）、放送モデルでは {modelled:.1f} m です。</translation>
    </message>
    <message>
        <source>The geoid separation was not given; the satellites say {offset:.1f} m (sigma {sigma:.1f} m), which is used: the official value is better.</source>
        <translation>ジオイド高が与えられていないため、衛星から求めた {offset:.1f} m（σ {sigma:.1f} m）を使用します。公式値の使用を推奨します。</translation>
    </message>
    <message>
        <source>The strongest signals contradict each other by {scatter:.1f} m at the places of the trajectory, more than the 1 to 3 m that are usual: check its times, its places and the lever arm of the antenna.</source>
        <translation>軌跡の位置において、最も強い信号どうしが {scatter:.1f} m 食い違い、通常の1～3 mを超えています。軌跡の時刻と位置、アンテナのレバーアームを確認してください。</translation>
    </message>
    <message>
        <source>No observation file is given: give the receiver's RINEX observation files.</source>
        <translation>観測ファイルが与えられていません。受信機のRINEX観測ファイルを指定してください。</translation>
    </message>
    <message>
        <source>without an ephemeris</source>
        <translation>エフェメリスなし</translation>
    </message>
    <message>
        <source>of unhealthy satellites</source>
        <translation>使用不可（unhealthy）と放送された衛星</translation>
    </message>
    <message>
        <source>below {elevation_mask:g} degrees of elevation</source>
        <translation>仰角 {elevation_mask:g} 度未満</translation>
    </message>
    <message>
        <source>No observation can be used ({value}): check that observations, navigation and trajectory belong together.</source>
        <translation>使用できる観測値がありません（{value}）。観測データ、航法ファイル、軌跡が対応しているか確認してください。</translation>
    </message>
    <message>
        <source>L5 is measured, but no navigation file tells its group delays (they are in the CNAV messages of RINEX 4): they are estimated for {names}, which is less sure.</source>
        <translation>L5が観測されていますが、その群遅延を含む航法ファイルがありません（群遅延はRINEX 4のCNAVメッセージにあります）。{names}については群遅延を推定しますが、確かさは下がります。</translation>
    </message>
    <message>
        <source>The navigation files tell no coefficients of the ionosphere: its delay, some metres, is not taken off; give a navigation file of GPS.</source>
        <translation>航法ファイルに電離層の係数がないため、電離層遅延（数m）を補正していません。GPSの航法ファイルを指定してください。</translation>
    </message>
    <message>
        <source>Precise orbits alone tell no group delays, up to some metres: they are not taken off; give the navigation files too.</source>
        <translation>精密暦だけでは群遅延（最大数m）が分からないため、補正していません。航法ファイルも指定してください。</translation>
    </message>
    <message>
        <source>have no ephemeris near in time</source>
        <translation>近い時刻のエフェメリスがない</translation>
    </message>
    <message>
        <source>are unhealthy</source>
        <translation>が使用不可（unhealthy）です</translation>
    </message>
    <message>
        <source>No satellite of {system_names} can be placed: its signals are left out; give its navigation file.</source>
        <translation>{system_names}の衛星の位置を計算できないため、その信号を除外しました。該当する航法ファイルを指定してください。</translation>
    </message>
    <message>
        <source>By the satellites the antenna is {offset:.0f} m {value} than the trajectory with a geoid separation of {given:g} m says: heights above sea level and above the ellipsoid seem to be mixed up; a separation of about {given_2:.0f} m would fit.</source>
        <translation>衛星によると、アンテナはジオイド高を {given:g} m とした軌跡より {offset:.0f} m {value}位置にあります。標高と楕円体高が混在しているようです。ジオイド高を約 {given_2:.0f} m とすると整合します。</translation>
    </message>
    <message>
        <source>too early, as UTC is</source>
        <translation>UTCのように早すぎます</translation>
    </message>
    <message>
        <source>too late</source>
        <translation>遅すぎます</translation>
    </message>
    <message>
        <source>The code ranges do not fit the trajectory (the strongest signals contradict each other by {scatter:.0f} m): its CRS, its times or the observation file are of another drive.</source>
        <translation>コード距離が軌跡と整合しません（最も強い信号どうしの食い違いが {scatter:.0f} m）。軌跡のCRSまたは時刻が誤っているか、観測ファイルが別の走行のものです。</translation>
    </message>
    <message>
        <source>{file} was observed {observed} GPS time, but the navigation files are good for {good}: give those of the same day.</source>
        <translation>{file}の観測はGPS時刻で{observed}ですが、航法ファイルの有効期間は{good}です。同じ日のものを指定してください。</translation>
    </message>
    <message>
        <source>Satellites that {why} are left out: {names}.</source>
        <translation>次の衛星を除外しました（{why}）: {names}。</translation>
    </message>
    <message>
        <source>By the satellites the antenna is {offset:.0f} m above the heights of the trajectory, more than any geoid separation: trajectory and observations do not belong together.</source>
        <translation>衛星によると、アンテナは軌跡の高さより {offset:.0f} m 上にあり、ジオイド高としてあり得ない値です。軌跡と観測データが対応していません。</translation>
    </message>
    <message>
        <source>The trajectory's times are {leap:.0f} s {fault}: give them in GPS time.</source>
        <translation>軌跡の時刻が {leap:.0f} s ずれています（{fault}）。GPS時刻で指定してください。</translation>
    </message>
    <message>
        <source>the files hold none</source>
        <translation>ファイルに一つもありません</translation>
    </message>
    <message>
        <source>higher</source>
        <translation>高い</translation>
    </message>
    <message>
        <source>lower</source>
        <translation>低い</translation>
    </message>
    <message>
        <source>{path} is of the time of none of the trajectories: give the trajectory of that drive, or leave the file out.</source>
        <translation>{path}の時刻はどの軌跡とも一致しません。その走行の軌跡を与えるか、このファイルを除いてください。</translation>
    </message>
    <message>
        <source>{path} may belong to {who}, which have the same times of the week: give trajectories in full GPS seconds.</source>
        <translation>{path}は、週内時刻が同じ{who}のいずれにも対応し得ます。軌跡を通算GPS秒で指定してください。</translation>
    </message>
    <message>
        <source>adjusted</source>
        <translation>調整済み</translation>
    </message>
    <message>
        <source>likely</source>
        <translation>推定</translation>
    </message>
    <message>
        <source>not observable</source>
        <translation>観測不可</translation>
    </message>
    <message>
        <source>held</source>
        <translation>保留</translation>
    </message>
    <message>
        <source>moved, the building would not stay valid or would run into another</source>
        <translation>移動すると建物が有効でなくなるか、ほかの建物に入り込みます</translation>
    </message>
    <message>
        <source>one satellite only</source>
        <translation>衛星が1個だけ</translation>
    </message>
    <message>
        <source>too few observations ({count} of {min_observations})</source>
        <translation>観測が少なすぎます（{min_observations} 必要、{count}）</translation>
    </message>
    <message>
        <source>too few satellites ({satellites} of {min_satellites})</source>
        <translation>衛星が少なすぎます（{min_satellites} 必要、{satellites}）</translation>
    </message>
    <message>
        <source>too few passes ({passes} of {min_passes})</source>
        <translation>走行が少なすぎます（{min_passes} 必要、{passes}）</translation>
    </message>
    <message>
        <source>contradicting observations: two offsets are possible</source>
        <translation>観測が矛盾：二通りのオフセットがあり得ます</translation>
    </message>
    <message>
        <source>contradicting observations: most are NLOS-delayed or outliers</source>
        <translation>観測が矛盾：大半がNLOS遅延か外れ値です</translation>
    </message>
    <message>
        <source>contradicting observations: the passes do not agree</source>
        <translation>観測が矛盾：走行どうしが一致しません</translation>
    </message>
    <message>
        <source>not precise enough (sigma {sigma:.2f} m)</source>
        <translation>精度不足（標準偏差 {sigma:.2f} m）</translation>
    </message>
    <message>
        <source>offset of {offset:.1f} m is not credible</source>
        <translation>{offset:.1f} m のオフセットは信頼できません</translation>
    </message>
    <message>
        <source>signals run along the wall (sigma {sigma:.2f} m)</source>
        <translation>信号が壁面に沿っている（標準偏差 {sigma:.2f} m）</translation>
    </message>
    <message>
        <source>no antenna in front of it</source>
        <translation>前方にアンテナがありません</translation>
    </message>
    <message>
        <source>no received signal could meet it</source>
        <translation>届き得る受信信号がありません</translation>
    </message>
    <message>
        <source>open sky: what it could reflect is in line of sight</source>
        <translation>開けた空：反射し得る信号は見通し内です</translation>
    </message>
    <message>
        <source>hidden behind other buildings</source>
        <translation>ほかの建物に隠れています</translation>
    </message>
    <message>
        <source>other walls could have reflected the same signals</source>
        <translation>ほかの壁面も同じ信号を反射し得ます</translation>
    </message>
    <message>
        <source>too few signals in a row</source>
        <translation>連続する信号が少なすぎます</translation>
    </message>
    <message>
        <source>At no epoch are three satellites in line of sight, so that the receiver's clock is not known: give observations of more satellites, or check heights and coordinate systems.</source>
        <translation>3衛星が見通し内にあるエポックがなく、受信機の時計誤差を決定できません。より多くの衛星の観測データを与えるか、高さと座標参照系を確認してください。</translation>
    </message>
    <message>
        <source>Outline {number} was drawn on {name}, which was not given (images: {known}): add the image or correct the field “image”.</source>
        <translation>外周線 {number} は{name}上に描かれていますが、その画像は与えられていません（画像: {known}）。画像を追加するか、フィールド「image」を修正してください。</translation>
    </message>
    <message>
        <source>No outline was drawn: draw polygons, lines or points on the images first.</source>
        <translation>外周線が描かれていません。先に画像上にポリゴン、線または点を描いてください。</translation>
    </message>
    <message>
        <source>Outline {number} does not say on which of the {sources_count} images it was drawn: fill the field “image” with the file's name.</source>
        <translation>外周線 {number} が {sources_count} 枚の画像のどれに描かれたか不明です。フィールド「image」にファイル名を入力してください。</translation>
    </message>
    <message>
        <source>Outline {number} lies outside {source} ({columns} x {rows} pixels): draw it on the image without a coordinate reference system, where y is negative.</source>
        <translation>外周線 {number} は{source}（{columns} x {rows} 画素）の外にあります。座標参照系のない画像上（yは負）に描いてください。</translation>
    </message>
    <message>
        <source>{points_count} laser points behind it are too few, or no group of them is connected (needed: {min_points})</source>
        <translation>背後のレーザ点 {points_count} 点は少なすぎるか、つながった点群がありません（{min_points} 点必要）</translation>
    </message>
    <message>
        <source>no laser points lie behind it</source>
        <translation>背後にレーザ点がありません</translation>
    </message>
    <message>
        <source>the surface runs along the line of sight</source>
        <translation>面が視線と平行です</translation>
    </message>
    <message>
        <source>too few points or too narrow for a plane of its own</source>
        <translation>独自の平面を求めるには点が少ないか狭すぎます</translation>
    </message>
    <message>
        <source>no laser points at {known_count} of {known_count_2} places</source>
        <translation>{known_count_2} か所中 {known_count} か所にレーザ点がありません</translation>
    </message>
    <message>
        <source>The models or lines have no heights, without which they have no place in an image: give models or lines with heights (for lines: QGIS's “Drape”).</source>
        <translation>モデルまたは線に高さがないため、画像上の位置を決定できません。高さ付きのモデルまたは線を指定してください（線にはQGISの「Drape」を使用）。</translation>
    </message>
    <message>
        <source>Edges should run along what the images show, and points lie on what they were measured from; where they do not, survey, orientation or models are off.</source>
        <translation>稜線は画像に写るものに沿い、点は計測対象の上に載るのが正常です。ずれている箇所では、計測データ、標定要素またはモデルに誤りがあります。</translation>
    </message>
    <message>
        <source> Nothing lies in {nothing_count} of {records_count} images.</source>
        <translation> {records_count} 枚中 {nothing_count} 枚には何も写りません。</translation>
    </message>
    <message>
        <source>{source}, columns {left} to {right}, rows {top} to {bottom}</source>
        <translation>{source}、列 {left}～{right}、行 {top}～{bottom}</translation>
    </message>
    <message>
        <source>Nothing lies in any of the images: check that images, trajectory, points and lines are of one place, in one coordinate system, and heights in metres.</source>
        <translation>どの画像にも写るものがありません。画像、軌跡、点、線が同じ場所・同じ座標系で、高さがメートル単位であることを確認してください。</translation>
    </message>
    <message>
        <source>{target} cannot be written ({strerror}): choose another folder.</source>
        <translation>{target}に書き込めません（{strerror}）。別のフォルダを選択してください。</translation>
    </message>
    <message>
        <source>points, {state}</source>
        <translation>点（{state}）</translation>
    </message>
    <message>
        <source>edges, {state} (pixels)</source>
        <translation>稜線（{state}、画素）</translation>
    </message>
    <message>
        <source>The textured model {path} must end in .glb, .obj or .city.json.</source>
        <translation>テクスチャ付きモデル{path}の拡張子は .glb、.obj または .city.json にしてください。</translation>
    </message>
    <message>
        <source>The folder {folder} cannot be made ({strerror}): choose another output.</source>
        <translation>フォルダ{folder}を作成できません（{strerror}）。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>There is no building model to texture: check the layer.</source>
        <translation>テクスチャを貼る建物モデルがありません。レイヤを確認してください。</translation>
    </message>
    <message>
        <source>Building {number} has no heights: give building models (MultiPolygonZ), such as those of “Building models”.</source>
        <translation>建物 {number} に高さがありません。「建物モデル」の出力などの建物モデル（MultiPolygonZ）を指定してください。</translation>
    </message>
    <message>
        <source>The strip image {name} was taken from {times:.1f} to {times_2:.1f} s, the trajectory runs from {time:.1f} to {time_2:.1f} s: give those of one survey.</source>
        <translation>ストリップ画像{name}の撮影時刻は {times:.1f}～{times_2:.1f} s ですが、軌跡は {time:.1f}～{time_2:.1f} s です。同じ計測のものを指定してください。</translation>
    </message>
    <message>
        <source>{path} is no geoid model: its header must name its first node and the steps between nodes in degrees, all greater than 0.</source>
        <translation>{path} はジオイドモデルではありません。ヘッダーには最初のグリッド点とグリッド間隔を度で、間隔は 0 より大きい値で書いてください。</translation>
    </message>
    <message>
        <source>{path} is no geoid model: its values must be heights of the geoid above the ellipsoid in metres, none beyond {highest:g}.</source>
        <translation>{path}はジオイドモデルではありません。値は楕円体からのジオイドの高さ（メートル）で、{highest:g} を超えない必要があります。</translation>
    </message>
    <message>
        <source>{path} is no geoid model: its cells must lie along latitude and longitude in degrees.</source>
        <translation>{path}はジオイドモデルではありません。セルは度単位の緯度・経度に沿う必要があります。</translation>
    </message>
    <message>
        <source>{name} holds {values_count} heights, its header says {rows}: the file is cut off; download it again.</source>
        <translation>{name}の高さの数は {values_count} 個ですが、ヘッダでは {rows} 個です。ファイルが途中で切れています。再度ダウンロードしてください。</translation>
    </message>
    <message>
        <source>{name} does not reach latitude {flat:.4f}, longitude {flat_2:.4f}: give the geoid model of the survey's place.</source>
        <translation>{name}は緯度 {flat:.4f}、経度 {flat_2:.4f} を覆っていません。計測地域のジオイドモデルを指定してください。</translation>
    </message>
    <message>
        <source>{path} cannot be read as a geoid model: give a GeoTIFF, a GTX or a text grid of GSI.</source>
        <translation>{path}をジオイドモデルとして読み込めません。GeoTIFF、GTXまたは国土地理院のテキスト形式グリッドを指定してください。</translation>
    </message>
    <message>
        <source>“{name}” of its header</source>
        <translation>ヘッダーの「{name}」</translation>
    </message>
    <message>
        <source>The data say that their heights are in {own}, not in {stated}: leave the system of the data empty.</source>
        <translation>データの高さは{stated}ではなく{own}と記載されています。データの高さの基準は空欄にしてください。</translation>
    </message>
    <message>
        <source>The data do not say what their heights count from: give the height system that they are in.</source>
        <translation>データに高さの基準の記載がありません。データの高さの基準を指定してください。</translation>
    </message>
    <message>
        <source>The height system of the result is not known: give JGD2000, JGD2011, JGD2024, ellipsoidal or an EPSG code.</source>
        <translation>結果の高さの基準が不明です。JGD2000、JGD2011、JGD2024、ellipsoidal またはEPSGコードを指定してください。</translation>
    </message>
    <message>
        <source>The heights are in {source} already: there is nothing to convert.</source>
        <translation>高さはすでに{source}です。変換の必要はありません。</translation>
    </message>
    <message>
        <source>The data have no coordinate reference system: assign the one that they are in.</source>
        <translation>データに座標参照系がありません。正しい座標参照系を割り当ててください。</translation>
    </message>
    <message>
        <source>Corrections are those of the older heights, so that from {source} to {target} they are added: leave “Against the grid” off.</source>
        <translation>補正量は古い高さに対するものなので、{source} から {target} へは加算します。「グリッドの逆方向」を外してください。</translation>
    </message>
    <message>
        <source>{path} holds no heights: give another raster.</source>
        <translation>{path}に高さがありません。別のラスタを指定してください。</translation>
    </message>
    <message>
        <source>{grid} holds at most {size:.2f} m, which are corrections: between ellipsoidal heights and those above the geoid give a geoid model.</source>
        <translation>{grid}の値は最大 {size:.2f} m で、標高補正値です。楕円体高と標高の間の変換にはジオイドモデルを指定してください。</translation>
    </message>
    <message>
        <source>{grid} holds up to {size:.1f} m, which is a geoid model: between {source} and {target} give the grid of corrections.</source>
        <translation>{grid}の値は最大 {size:.1f} m で、ジオイドモデルです。{source}と{target}の間の変換には標高補正のグリッドを指定してください。</translation>
    </message>
    <message>
        <source>From {source} to {target} no transformation of {rough:g} m or better is known here: transform the data first, between Japan's datums with GSI's TKY2JGD or PatchJGD.</source>
        <translation>{source}から{target}への {rough:g} m 以内の精度の変換がありません。先にデータを変換してください（日本の測地系間では国土地理院のTKY2JGDまたはPatchJGD）。</translation>
    </message>
    <message>
        <source>A coordinate reference system has no horizontal part: set another one.</source>
        <translation>座標参照系に水平成分がありません。別のものを設定してください。</translation>
    </message>
    <message>
        <source>{path} cannot be taken to where the other data lie: check the coordinate reference systems.</source>
        <translation>{path}を他のデータの位置に変換できません。座標参照系を確認してください。</translation>
    </message>
    <message>
        <source>Some places lie outside of where the reference system can be computed: check the coordinate reference systems.</source>
        <translation>座標参照系の計算可能範囲の外にある地点があります。座標参照系を確認してください。</translation>
    </message>
    <message>
        <source>A coordinate reference system cannot be understood: set another one.</source>
        <translation>座標参照系を解釈できません。別のものを設定してください。</translation>
    </message>
    <message>
        <source>The reference system EPSG:{code} is not known here: choose another.</source>
        <translation>座標参照系 EPSG:{code} は未対応です。別のものを選択してください。</translation>
    </message>
    <message>
        <source>{shown} cannot be written: make room on its disk, or choose another output.</source>
        <translation>{shown}に書き込めません。ディスクの空き容量を確保するか、別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>{shown} cannot be written ({strerror}).</source>
        <translation>{shown}に書き込めません（{strerror}）。</translation>
    </message>
    <message>
        <source>{shown} cannot be replaced ({strerror}): close the program that has it open.</source>
        <translation>{shown}を置き換えられません（{strerror}）。ファイルを開いているプログラムを閉じてください。</translation>
    </message>
    <message>
        <source>{name} cannot be read as {what}{reason}: it is damaged or of another kind; export or download it again.</source>
        <translation>{name}を{what}として読み込めません{reason}。破損しているか、種類が異なります。再度出力またはダウンロードしてください。</translation>
    </message>
    <message>
        <source>{name}: {part} cannot be read{reason}: correct it, or export or download the file again.</source>
        <translation>{name}：{part} を読めません{reason}。直すか、ファイルを出力またはダウンロードし直してください。</translation>
    </message>
    <message>
        <source> (it is no text in UTF-8)</source>
        <translation>（UTF-8の文字列ではありません）</translation>
    </message>
    <message>
        <source> (it is nested too deep)</source>
        <translation>（入れ子が深すぎます）</translation>
    </message>
    <message>
        <source> (a number in it is too large)</source>
        <translation>（大きすぎる数値があります）</translation>
    </message>
    <message>
        <source> (line {line} is no XML)</source>
        <translation>（{line} 行目が XML ではありません）</translation>
    </message>
    <message>
        <source> (line {line} is no JSON)</source>
        <translation>（{line} 行目が JSON ではありません）</translation>
    </message>
    <message>
        <source> (“{name}” is missing in it)</source>
        <translation>（“{name}” がありません）</translation>
    </message>
    <message>
        <source> (“{value}” is no number)</source>
        <translation>（“{value}” は数値ではありません）</translation>
    </message>
    <message>
        <source>{path} cannot be read as {what}: “{number}” in its line {line} is no number that could be used; correct it, or export it again.</source>
        <translation>{path} を {what} として読めません。{line} 行目の「{number}」は使える数ではありません。直すか、出力し直してください。</translation>
    </message>
    <message>
        <source>{path} cannot be read as {what}{reason}: it is not JSON, or damaged; export it again.</source>
        <translation>{path}を{what}として読み込めません{reason}。JSONでないか、破損しています。再度出力してください。</translation>
    </message>
    <message>
        <source>{name}: {columns} may count north or east (in the Japanese plane rectangular system X counts north): read it by “Import table…” in the menu UrbanMap, which shows the columns, or call the one that counts east “東” or “east”, and the one that counts north “北” or “north”.</source>
        <translation>{name}：{columns}が北方向か東方向か判別できません（平面直角座標系ではXが北方向です）。メニュー「UrbanMap」の「表の取り込み…」で列を確認して読み込むか、東方向の列名を「東」、北方向の列名を「北」にしてください。</translation>
    </message>
    <message>
        <source>{name} has its places in latitude and longitude ({columns}): read it by “Import table…” in the menu UrbanMap, which lays them into the plane reference system of the survey.</source>
        <translation>{name}の位置は緯度・経度（{columns}）です。メニュー「UrbanMap」の「表の取り込み…」で、計測の平面座標系に変換して読み込んでください。</translation>
    </message>
    <message>
        <source>{name} has several columns that could be {meant} ({keys}): keep the right one, or call it {meant}.</source>
        <translation>{name} には {meant} とみなせる列が複数あります（{keys}）。正しい列だけを残すか、その列名を {meant} にしてください。</translation>
    </message>
    <message>
        <source>{name}: “{text}” in row {row} of the column {column} is no number: correct or remove it.</source>
        <translation>{name}：{row} 行目、列 {column} の「{text}」は数値ではありません。修正するか削除してください。</translation>
    </message>
    <message>
        <source>{name} states the unit {unit}: metres, seconds and decimal degrees are read; export it in these.</source>
        <translation>{name} の単位が {unit} になっています。読めるのはメートル、秒、度（十進）です。これらの単位で書き出してください。</translation>
    </message>
    <message>
        <source>{label} holds more than {largest_zip} GB: unpack it first.</source>
        <translation>{label}は {largest_zip} GB を超えています。先に展開してください。</translation>
    </message>
    <message>
        <source>{name}: {north} counts north and {east} east, by the names, the numbers or the headings of the table; if that is wrong, call the columns “東” and “北”.</source>
        <translation>{name}：表の列名、数値または方位角から、{north}を北方向、{east}を東方向としました。違う場合は列名を「東」「北」にしてください。</translation>
    </message>
    <message>
        <source>No rule has a code that begins with {code}; the documentation lists them.</source>
        <translation>{code} で始まるコードの規則はありません。一覧は説明書にあります。</translation>
    </message>
    <message>
        <source>{target} is a folder; give the name of a file.</source>
        <translation>{target}はフォルダです。ファイル名を指定してください。</translation>
    </message>
    <message>
        <source>{target} is no plain file; give another name.</source>
        <translation>{target}は通常のファイルではありません。別の名前を指定してください。</translation>
    </message>
    <message>
        <source>{target} is open in another program, or is edited in this one; close it there, or choose another output.</source>
        <translation>{target}は他のプログラムで開かれているか、このプログラムで編集中です。閉じるか、別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>The name {name} is too long for the files that are made beside it: give a shorter one, of at most {longest} bytes.</source>
        <translation>ファイル名 {name} は、同じ場所に作られる補助ファイルのために長すぎます。{longest} バイト以内の名前にしてください。</translation>
    </message>
    <message>
        <source>The folder {folder} does not exist; create it or choose another output.</source>
        <translation>フォルダ{folder}が存在しません。作成するか、別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>The folder {folder} cannot be written; choose another output.</source>
        <translation>フォルダ{folder}に書き込めません。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>{target} cannot be the name of a file ({reason}); choose another output.</source>
        <translation>{target}はファイル名として使用できません（{reason}）。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>The folder {folder} cannot be written ({strerror}): choose another output.</source>
        <translation>フォルダ{folder}に書き込めません（{strerror}）。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>{final_text} cannot be replaced ({strerror}): close the program that has it open, or choose another output.</source>
        <translation>{final_text}を置き換えられません（{strerror}）。ファイルを開いているプログラムを閉じるか、別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>{first} holds no buildings: choose another map sheet.</source>
        <translation>{first} に建物がありません。別の図郭を選択してください。</translation>
    </message>
    <message>
        <source>None of the buildings in {first} has a usable outline: {some}.</source>
        <translation>{first}の建物に使用できる外周線がありません: {some}。</translation>
    </message>
    <message>
        <source>{first} holds no building outlines (BldA or BldL) but {kinds}: give the buildings' file.</source>
        <translation>{first} には建築物の外周線（BldAまたはBldL）がなく、{kinds} があります。建物のファイルを指定してください。</translation>
    </message>
    <message>
        <source>{not_gsi} is not GSI Fundamental Geospatial Data (its root is not an FGD Dataset): give files named FG-GML-...-BldA or -BldL as downloaded.</source>
        <translation>{not_gsi} は基盤地図情報ではありません（ルートがFGD Datasetではありません）。ダウンロードしたままのFG-GML-...-BldAまたは-BldLのファイルを指定してください。</translation>
    </message>
    <message>
        <source>The outlines are in JGD2000 and were taken into {target} without the movements of the ground in 2011, up to 5 m in north-east Japan: correct them there with PatchJGD.</source>
        <translation>外周線はJGD2000で、2011年の地殻変動（東北地方で最大5 m）を考慮せずに{target}へ変換しました。当該地域ではPatchJGDで補正してください。</translation>
    </message>
    <message>
        <source>{zones_count} of {zones_count_2} buildings seem to lie outside zone {zone_names}, in {others}: choose the reference system if that is not wanted.</source>
        <translation>{zones_count_2} 棟中 {zones_count} 棟が {zone_names} 系の外、{others} にあるようです。意図しない場合は座標参照系を選択してください。</translation>
    </message>
    <message>
        <source>{same_areas} objects that several files hold alike were taken once.</source>
        <translation>複数のファイルに同じ内容で含まれる地物 {same_areas} 件は一度だけ取り込みました。</translation>
    </message>
    <message>
        <source>{known} outlines (BldL) of buildings that are there as areas (BldA) were left out.</source>
        <translation>面（BldA）のある建物の外周線（BldL） {known} 件を除きました。</translation>
    </message>
    <message>
        <source>{mended} outlines that cross or touch themselves were repaired.</source>
        <translation>自己交差または自己接触する外周線 {mended} 件を修復しました。</translation>
    </message>
    <message>
        <source>No outline in {source} closes to a polygon: give all map sheets around the area, or BldA files.</source>
        <translation>{source}の外周線はいずれもポリゴンとして閉じません。範囲周辺のすべての図郭、またはBldAファイルを指定してください。</translation>
    </message>
    <message>
        <source>The reference system {unknown} of the outlines is not known: give data in JGD2000, JGD2011 or JGD2024 (latitude and longitude).</source>
        <translation>外周線の座標参照系{unknown}は未対応です。JGD2000、JGD2011またはJGD2024（緯度・経度）のデータを指定してください。</translation>
    </message>
    <message>
        <source>Some outlines are in JGD2000 and others in JGD2011 or JGD2024, which lie up to 5 m apart: load them in separate runs.</source>
        <translation>JGD2000の外周線と、JGD2011またはJGD2024の外周線が混在しており、最大5 mの差があります。別々に実行して読み込んでください。</translation>
    </message>
    <message>
        <source>The outlines name no reference system; JGD2011 was taken.</source>
        <translation>外周線に座標参照系の記載がないため、JGD2011としました。</translation>
    </message>
    <message>
        <source>JGD2024 was taken as JGD2011 (EPSG:6668): their horizontal coordinates are the same.</source>
        <translation>JGD2024をJGD2011（EPSG:6668）として扱いました。水平座標は同一です。</translation>
    </message>
    <message>
        <source>{others_count} files with other objects than buildings were not opened ({some}).</source>
        <translation>建物以外の地物のファイル {others_count} 件は開きませんでした（{some}）。</translation>
    </message>
    <message>
        <source>{not_gsi_count} XML files that are not GSI data were passed over ({some}).</source>
        <translation>国土地理院データでないXMLファイル {not_gsi_count} 件を読み飛ばしました（{some}）。</translation>
    </message>
    <message>
        <source>Objects that are no building outlines were passed over ({kinds}).</source>
        <translation>建物外周線でない地物を読み飛ばしました（{kinds}）。</translation>
    </message>
    <message>
        <source>{unusable_count} buildings have no usable outline and are missing in the result: {some}.</source>
        <translation>使える外周線のない建物 {unusable_count} 棟は結果にありません：{some}。</translation>
    </message>
    <message>
        <source>{gaps_count} gaps in outlines were closed by a straight line, the widest {gaps:.2g} m.</source>
        <translation>外周線の切れ目 {gaps_count} か所を直線で閉じました。最大 {gaps:.2g} m。</translation>
    </message>
    <message>
        <source>{curved_objects} curve segments ({kinds}) were replaced by straight lines between the points they give.</source>
        <translation>曲線部分 {curved_objects} 件（{kinds}）を、与えられた点を結ぶ直線に置き換えました。</translation>
    </message>
    <message>
        <source>The buildings cannot be turned into {target}: choose a reference system made for Japan.</source>
        <translation>建物を{target}に変換できません。日本用の座標参照系を選択してください。</translation>
    </message>
    <message>
        <source>The reference system {crs} is not known: choose another.</source>
        <translation>座標参照系{crs}は未対応です。別のものを選択してください。</translation>
    </message>
    <message>
        <source>{source}: cells of {cell:.3f} seconds are of no elevation model of the GSI; give {what} as they were downloaded.</source>
        <translation>{source}: {cell:.3f} 秒のセルは国土地理院の標高モデルのものではありません。{what}をダウンロードしたまま指定してください。</translation>
    </message>
    <message>
        <source>{strange} is no elevation model of the GSI: give {what} as they were downloaded.</source>
        <translation>{strange}は国土地理院の標高モデルではありません。{what}をダウンロードしたまま指定してください。</translation>
    </message>
    <message>
        <source>Some meshes are in {systems} and others in {systems_2}, whose heights differ by up to decimetres: load them in separate runs and convert one with “Convert heights”.</source>
        <translation>{systems}のメッシュと{systems_2}のメッシュが混在しており、高さに最大で数dmの差があります。別々に実行して読み込み、一方を「高さの基準の変換」で変換してください。</translation>
    </message>
    <message>
        <source>{source} is damaged: its elevation model has no coverage; download it again.</source>
        <translation>{source}が破損しています。標高モデルにカバレッジがありません。再度ダウンロードしてください。</translation>
    </message>
    <message>
        <source>{source} is damaged: its grid of {columns} x {rows} cells cannot be; download it again.</source>
        <translation>{source}が破損しています。{columns} x {rows} セルのグリッドはあり得ません。再度ダウンロードしてください。</translation>
    </message>
    <message>
        <source>{source} is damaged: its cells are not as high as wide; download it again.</source>
        <translation>{source}が破損しています。セルの縦と横の長さが異なります。再度ダウンロードしてください。</translation>
    </message>
    <message>
        <source>{source}: the reference system {value} is not known: give data in JGD2000, JGD2011 or JGD2024.</source>
        <translation>{source}: 座標参照系{value}は未対応です。JGD2000、JGD2011またはJGD2024のデータを指定してください。</translation>
    </message>
    <message>
        <source>{source} is damaged: {name} does not hold two numbers; download it again.</source>
        <translation>{source}が破損しています。{name}が2つの数値になっていません。再度ダウンロードしてください。</translation>
    </message>
    <message>
        <source>{source}: its cells are in an order ({order}) that is not known; download it again.</source>
        <translation>{source}: セルの並び順（{order}）は未対応です。再度ダウンロードしてください。</translation>
    </message>
    <message>
        <source>{source} is damaged: it has more heights than its {columns} x {rows} cells from its start point on; download it again.</source>
        <translation>{source}が破損しています。開始点以降の高さの数が {columns} x {rows} セルを超えています。再度ダウンロードしてください。</translation>
    </message>
    <message>
        <source>{others_count} files with other data than elevation models were not opened ({some}).</source>
        <translation>標高モデル以外のファイル {others_count} 件は開きませんでした（{some}）。</translation>
    </message>
    <message>
        <source>{strange_count} XML files that are no elevation models were passed over ({some}).</source>
        <translation>標高モデルでないXMLファイル {strange_count} 件を読み飛ばしました（{some}）。</translation>
    </message>
    <message>
        <source>{older_count} older files of meshes that have a newer one were left out ({some}).</source>
        <translation>新しいものがあるメッシュの古いファイル {older_count} 件を除きました（{some}）。</translation>
    </message>
    <message>
        <source>{surface} cells of {values} are heights of the surface (表層面), with trees and buildings, not of the ground.</source>
        <translation>{values} セル中 {surface} セルは地表ではなく、樹木や建物を含む表層面の高さです。</translation>
    </message>
    <message>
        <source>{source} is damaged: {line!r} is no kind with a height; download it again.</source>
        <translation>{source}が破損しています。{line!r} は種別と高さの組ではありません。再度ダウンロードしてください。</translation>
    </message>
    <message>
        <source>{source} is damaged: a height is no number; download it again.</source>
        <translation>{source}が破損しています。高さが数値ではありません。再度ダウンロードしてください。</translation>
    </message>
    <message>
        <source>The raster would have {columns} x {rows} cells: load fewer meshes at a time, or choose a coarser resolution.</source>
        <translation>ラスタが {columns} x {rows} セルになります。一度に読み込むメッシュを減らすか、解像度を粗くしてください。</translation>
    </message>
    <message>
        <source>The elevation model lies outside of where the reference system can be computed: choose one made for Japan.</source>
        <translation>標高モデルが座標参照系の計算可能範囲の外にあります。日本用のものを選択してください。</translation>
    </message>
    <message>
        <source>its surface has no exterior</source>
        <translation>面に外周がありません</translation>
    </message>
    <message>
        <source>a ring has no coordinates</source>
        <translation>座標のない輪があります</translation>
    </message>
    <message>
        <source>a ring has fewer than three corners</source>
        <translation>頂点が3点未満の輪があります</translation>
    </message>
    <message>
        <source>its line has no coordinates</source>
        <translation>線に座標がありません</translation>
    </message>
    <message>
        <source>its line has a single point</source>
        <translation>線が1点だけです</translation>
    </message>
    <message>
        <source>a latitude has no longitude</source>
        <translation>緯度に対応する経度がありません</translation>
    </message>
    <message>
        <source>a coordinate is not a number</source>
        <translation>座標が数値ではありません</translation>
    </message>
    <message>
        <source>it lies outside Japan</source>
        <translation>日本の外にあります</translation>
    </message>
    <message>
        <source>it has no surface</source>
        <translation>面がありません</translation>
    </message>
    <message>
        <source>{courtyards} closed outlines (BldL) inside another of the same type were taken as courtyards.</source>
        <translation>同じ種別の外周線の内側にある閉じた外周線（BldL） {courtyards} 件を中庭としました。</translation>
    </message>
    <message>
        <source>{sum} open outlines (BldL) that close rings together became {polygons_count} buildings: check them, a ring may also lie between buildings.</source>
        <translation>互いに閉じる開いた外周線（BldL） {sum} 本から建物 {polygons_count} 棟を作りました。建物の間の輪のこともあるため確認してください。</translation>
    </message>
    <message>
        <source>{sum} open outlines (BldL) close no ring and are missing in the result: give the neighbouring map sheets too, or BldA files.</source>
        <translation>閉じない外周線（BldL） {sum} 本は結果にありません。隣の図郭も与えるか、BldAのファイルを指定してください。</translation>
    </message>
    <message>
        <source>No file was given: choose {what} ({suffixes}, .zip or a folder of them).</source>
        <translation>ファイルが与えられていません。{what}（{suffixes}、.zip、またはそれらのフォルダ）を選択してください。</translation>
    </message>
    <message>
        <source>{given} holds no {what} but {others}: {advice}.</source>
        <translation>{given}には{what}がなく、{others}があります。{advice}。</translation>
    </message>
    <message>
        <source>{path} does not exist: check the path.</source>
        <translation>{path}が存在しません。パスを確認してください。</translation>
    </message>
    <message>
        <source>{name} is a zip nested more than {deepest_zip} deep: unpack it first.</source>
        <translation>{name}は {deepest_zip} 段を超えて入れ子になったzipです。先に展開してください。</translation>
    </message>
    <message>
        <source>{path} holds no {suffixes} file: give {what} as they were downloaded.</source>
        <translation>{path}に{suffixes}ファイルがありません。{what}をダウンロードしたまま指定してください。</translation>
    </message>
    <message>
        <source>{label} is encrypted: unpack it with its password and give the files in it.</source>
        <translation>{label}は暗号化されています。パスワードで展開し、中のファイルを指定してください。</translation>
    </message>
    <message>
        <source>{label} would unpack to {file_size} GB from {compress_size} MB, which no map data does: get the file again from where it comes from.</source>
        <translation>{label}は {compress_size} MB から {file_size} GB に展開されるため、地図データではあり得ません。提供元からファイルを再度取得してください。</translation>
    </message>
    <message>
        <source>{name} is damaged or not a zip file ({error}): download it again.</source>
        <translation>{name}は破損しているか、zipファイルではありません（{error}）。再度ダウンロードしてください。</translation>
    </message>
    <message>
        <source>{name} cannot be unpacked here ({error}): unpack it and give the files in it.</source>
        <translation>{name}を展開できません（{error}）。別途展開し、中のファイルを指定してください。</translation>
    </message>
    <message>
        <source>{name} cannot be read ({value}): check the file.</source>
        <translation>{name}を読み込めません（{value}）。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{name} declares the unknown encoding {encoding}: save it as UTF-8.</source>
        <translation>{name}に指定されている文字コード{encoding}は未対応です。UTF-8で保存してください。</translation>
    </message>
    <message>
        <source>{source} is not whole, valid XML (line {line}, column {column}): get the file again from where it comes from.</source>
        <translation>{source}は完全で有効なXMLではありません（{line} 行 {column} 列）。提供元からファイルを再度取得してください。</translation>
    </message>
    <message>
        <source>{name} holds bytes that are not valid {encoding}: download it again or correct its declared encoding.</source>
        <translation>{name}に{encoding}として無効なバイトがあります。再度ダウンロードするか、文字コードの宣言を修正してください。</translation>
    </message>
    <message>
        <source>{name} has no object in its first {longest_prolog} MB: get the file again from where it comes from.</source>
        <translation>{name}の先頭 {longest_prolog} MB にオブジェクトがありません。提供元からファイルを再度取得してください。</translation>
    </message>
    <message>
        <source>{name} has a document type declaration, which {maker} never has and which may be harmful: get the file again from where it comes from.</source>
        <translation>{name}に文書型宣言があります。{maker}のファイルには含まれないもので、有害な可能性があります。提供元からファイルを再度取得してください。</translation>
    </message>
    <message>
        <source>{source} has an object of more than {largest} MB: get the file again from where it comes from.</source>
        <translation>{source}に {largest} MB を超えるオブジェクトがあります。提供元からファイルを再度取得してください。</translation>
    </message>
    <message>
        <source>{tag} (element {number} of the file)</source>
        <translation>{tag}（ファイルの {number} 番目の要素）</translation>
    </message>
    <message>
        <source>{path} is an OpenDRIVE file, which is written here and not read: give the Lanelet2 file (.osm) of the map.</source>
        <translation>{path}はOpenDRIVEファイルです。OpenDRIVEは出力のみで、読み込みには対応していません。地図のLanelet2ファイル（.osm）を指定してください。</translation>
    </message>
    <message>
        <source>{path} is no OSM file: its outermost element is {tag}, not osm.</source>
        <translation>{path}はOSMファイルではありません。最上位の要素が osm ではなく {tag} です。</translation>
    </message>
    <message>
        <source>Made by</source>
        <translation>作成ソフトウェア</translation>
    </message>
    <message>
        <source>Day</source>
        <translation>作成日</translation>
    </message>
    <message>
        <source>{caption} ({missing} without a value)</source>
        <translation>{caption}（値なし {missing} 件）</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>注記</translation>
    </message>
    <message>
        <source>How this was made</source>
        <translation>作成方法</translation>
    </message>
    <message>
        <source>{path} is no PNG or JPEG picture: a report can hold only these.</source>
        <translation>{path}はPNGまたはJPEGの画像ではありません。報告書に使用できるのはこれらの形式だけです。</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>設定</translation>
    </message>
    <message>
        <source>not known</source>
        <translation>不明</translation>
    </message>
    <message>
        <source>predicted, m</source>
        <translation>予測 (m)</translation>
    </message>
    <message>
        <source>error {length:g} cm</source>
        <translation>較差 {length:g} cm</translation>
    </message>
    <message>
        <source>The coordinates of the points are rounded ({axes}), and what is found by them is no more accurate: export the points with finer coordinates.</source>
        <translation>点の座標が丸められています（{axes}）。結果の精度もそれより良くはなりません。座標の桁数を増やして点群を書き出してください。</translation>
    </message>
    <message>
        <source>{axis} in steps of {step:g} m</source>
        <translation>{axis} は {step:g} m 単位</translation>
    </message>
    <message>
        <source>it does not begin as such a file does</source>
        <translation>この種のファイルの先頭ではありません</translation>
    </message>
    <message>
        <source>its version {version}.{version_2} is none that is known</source>
        <translation>版 {version}.{version_2} は未知です</translation>
    </message>
    <message>
        <source>its header and the place of its points do not fit its size</source>
        <translation>ヘッダと点の位置がファイルの大きさに合いません</translation>
    </message>
    <message>
        <source>its point format {point_format} is none that is known</source>
        <translation>点形式 {point_format} は未知です</translation>
    </message>
    <message>
        <source>its records of {record_length} bytes are too short for point format {point_format}</source>
        <translation>{record_length} バイトの記録は点形式 {point_format} には短すぎます</translation>
    </message>
    <message>
        <source>its scales, offsets or bounds are no usable numbers</source>
        <translation>縮尺、原点または範囲が使える数値ではありません</translation>
    </message>
    <message>
        <source>there is no room for its {vlrs:,} variable length records</source>
        <translation>可変長レコード {vlrs:,} 件の入る余地がありません</translation>
    </message>
    <message>
        <source>its record of extra attributes is cut off</source>
        <translation>追加属性の記録が途中で切れています</translation>
    </message>
    <message>
        <source>its record of extra attributes holds one of no known kind</source>
        <translation>追加属性の記録に未知の種類があります</translation>
    </message>
    <message>
        <source>its record of extra attributes describes {sizes} bytes a point, and its points have room for {room}</source>
        <translation>追加属性のレコードは1点あたり {sizes} バイトと記していますが、点には {room} バイト分しかありません</translation>
    </message>
    <message>
        <source>there is no room for its {evlrs:,} extended records</source>
        <translation>拡張レコード {evlrs:,} 件の入る余地がありません</translation>
    </message>
    <message>
        <source>it is compressed, but its record on the compression is missing</source>
        <translation>圧縮されていますが、圧縮の記録がありません</translation>
    </message>
    <message>
        <source>its record on the compression is cut off</source>
        <translation>圧縮の記録が途中で切れています</translation>
    </message>
    <message>
        <source>its record on the compression is none that is known</source>
        <translation>圧縮の記録が未知のものです</translation>
    </message>
    <message>
        <source>its record on the compression does not fit its points</source>
        <translation>圧縮の記録が点に合いません</translation>
    </message>
    <message>
        <source>the table of its chunks is not where it says</source>
        <translation>チャンクの表が示された位置にありません</translation>
    </message>
    <message>
        <source>there is no room for its {number:,} chunks</source>
        <translation>チャンク {number:,} 個の入る余地がありません</translation>
    </message>
    <message>
        <source>its {number:,} chunks do not hold {count:,} points</source>
        <translation>チャンク {number:,} 個に {count:,} 点は入りません</translation>
    </message>
    <message>
        <source>it says that its chunks hold {chunk_size:,} points</source>
        <translation>チャンクに {chunk_size:,} 点が入るとされています</translation>
    </message>
    <message>
        <source>the table of its chunks does not fit its size</source>
        <translation>チャンクの表がファイルの大きさに合いません</translation>
    </message>
    <message>
        <source>its chunks do not hold {count:,} points</source>
        <translation>チャンクに {count:,} 点は入りません</translation>
    </message>
    <message>
        <source>{path} cannot be read ({strerror}).</source>
        <translation>{path}を読み込めません（{strerror}）。</translation>
    </message>
    <message>
        <source>its header is cut off</source>
        <translation>ヘッダが途中で切れています</translation>
    </message>
    <message>
        <source>{path} cannot be read as LAS or LAZ ({reason}): copy or download it again, or convert it if it is of another kind.</source>
        <translation>{path}をLASまたはLAZとして読み込めません（{reason}）。再度コピーまたはダウンロードするか、別の形式であれば変換してください。</translation>
    </message>
    <message>
        <source>{path} is damaged: copy or download it again.</source>
        <translation>{path}が破損しています。再度コピーまたはダウンロードしてください。</translation>
    </message>
    <message>
        <source>its variable length records reach into its points</source>
        <translation>可変長レコードが点にまで及んでいます</translation>
    </message>
    <message>
        <source>its extended records reach beyond its end</source>
        <translation>拡張レコードがファイルの終わりを越えています</translation>
    </message>
    <message>
        <source>the lengths within a chunk do not fit it</source>
        <translation>チャンク内の長さが合いません</translation>
    </message>
    <message>
        <source>it is truncated: it holds {held:,} of {count:,} points</source>
        <translation>途中で切れています：{count:,} 点中 {held:,} 点</translation>
    </message>
    <message>
        <source>{path} says that it is in {stated}; {given} counts, which was given for it.</source>
        <translation>{path} は {stated} と記していますが、指定された {given} を使います。</translation>
    </message>
    <message>
        <source>The box in the header of {path} does not hold its points: it was found from them.</source>
        <translation>{path} のヘッダーの範囲に点が入っていないため、範囲を点から求めました。</translation>
    </message>
    <message>
        <source>No point cloud was given: choose one or several LAS or LAZ files.</source>
        <translation>点群が与えられていません。LASまたはLAZファイルを1つ以上選択してください。</translation>
    </message>
    <message>
        <source>{files} holds no points: choose another point cloud.</source>
        <translation>{files}に点がありません。別の点群を選択してください。</translation>
    </message>
    <message>
        <source>{files} has coordinates that are not numbers: repair the file's header.</source>
        <translation>{files}に数値でない座標があります。ファイルのヘッダを修復してください。</translation>
    </message>
    <message>
        <source>The point cloud {path} does not exist.</source>
        <translation>点群{path}が存在しません。</translation>
    </message>
    <message>
        <source>{path} must end in .laz or .las.</source>
        <translation>{path}の拡張子は .laz または .las にしてください。</translation>
    </message>
    <message>
        <source>{path} is in {crs}, but {stated} is in {stated_2}: give files of one coordinate reference system.</source>
        <translation>{path}は{crs}ですが、{stated}は{stated_2}です。同じ座標参照系のファイルを指定してください。</translation>
    </message>
    <message>
        <source>{path} cannot be read as LAS or LAZ ({error}): it may be truncated or of another kind.</source>
        <translation>{path}をLASまたはLAZとして読み込めません（{error}）。途中で切れているか、別の形式の可能性があります。</translation>
    </message>
    <message>
        <source>{path} is truncated: it holds {read:,} of {point_count:,} points; copy or download it again.</source>
        <translation>{path}は途中で切れており、{point_count:,} 点のうち {read:,} 点しかありません。再度コピーまたはダウンロードしてください。</translation>
    </message>
    <message>
        <source>{path} is damaged or truncated after {read:,} of {point_count:,} points: copy or download it again.</source>
        <translation>{path}は {point_count:,} 点のうち {read:,} 点以降が破損しているか、途切れています。再度コピーまたはダウンロードしてください。</translation>
    </message>
    <message>
        <source>{path} contradicts itself: {crs} counts in units of {own:.4f} m, and the file says that its units are {unit:.4f} m. Give the reference system that it is in.</source>
        <translation>{path} は矛盾しています。{crs} の単位は {own:.4f} m ですが、ファイルは単位を {unit:.4f} m と記しています。正しい座標系を指定してください。</translation>
    </message>
    <message>
        <source>{path} states two reference systems: {crs} counts, as its header says, and not {other}.</source>
        <translation>{path} は2つの座標系を記しています。ヘッダーに従い {other} ではなく {crs} を使います。</translation>
    </message>
    <message>
        <source>The coordinate reference system in {path} cannot be understood: set it right in the file.</source>
        <translation>{path}の座標参照系を解釈できません。ファイルに正しく設定してください。</translation>
    </message>
    <message>
        <source>{path} is turned or its cells are not square: warp it to a north-up raster first.</source>
        <translation>{path}は回転しているか、セルが正方形ではありません。先に北を上にしたラスタに再投影してください。</translation>
    </message>
    <message>
        <source>{path} cannot be written ({error}): choose another output.</source>
        <translation>{path}に書き込めません（{error}）。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>{path} has {bands} bands, no band {band}.</source>
        <translation>{path}のバンド数は {bands} で、バンド {band} はありません。</translation>
    </message>
    <message>
        <source>{path} has the value {value:g} where it holds no height, and does not say that it stands for no data: such cells are taken as empty.</source>
        <translation>{path} には高さのない場所に値 {value:g} があり、それがデータなしを表すと示されていません。そのセルは空として扱います。</translation>
    </message>
    <message>
        <source>The height system {word} is not known: give JGD2000, JGD2011, JGD2024, ellipsoidal or the EPSG code of a vertical reference system.</source>
        <translation>高さの基準{word}は未対応です。JGD2000、JGD2011、JGD2024、ellipsoidal または鉛直座標参照系のEPSGコードを指定してください。</translation>
    </message>
    <message>
        <source>{label_a} has heights in {first}, but {label_b} in {second}: convert one of them with “Convert heights” and the correction or geoid grid for it.</source>
        <translation>{label_a}の高さは{first}ですが、{label_b}の高さは{second}です。「高さの基準の変換」と対応する標高補正グリッドまたはジオイドモデルで一方を変換してください。</translation>
    </message>
    <message>
        <source>{datum} / Japan Plane Rectangular CS {zone}</source>
        <translation>{datum} / 平面直角座標系 第{zone}系</translation>
    </message>
    <message>
        <source>{datum} / UTM zone {zone}N</source>
        <translation>{datum} / UTM座標系 第{zone}帯（北半球）</translation>
    </message>
    <message>
        <source>{datum} (vertical) height</source>
        <translation>{datum} 標高</translation>
    </message>
    <message>
        <source>{name} states no coordinate reference system: assign one to the file first.</source>
        <translation>{name}に座標参照系の記載がありません。先にファイルに設定してください。</translation>
    </message>
    <message>
        <source>{name} is in {crs}, which is no system of plane coordinates in metres: reproject it to one first.</source>
        <translation>{name} は {crs} ですが、これはメートル単位の平面座標系ではありません。先にそのような座標系へ投影変換してください。</translation>
    </message>
    <message>
        <source>{name}: in {crs} lengths at this place are {scale:.3f} times those on the ground; reproject to a system whose metres are metres, such as {zone}. If the data lie elsewhere, they are in another system than they say.</source>
        <translation>{name}：{crs} では、この場所の長さが実際の {scale:.3f} 倍になります。1メートルが実際の1メートルになる座標系（{zone} など）に変換してください。データが別の場所のものであれば、記された座標系が誤っています。</translation>
    </message>
    <message>
        <source>{name}: in {crs} lengths at this place are {scale:.5f} times those on the ground; so are the lengths of the results.</source>
        <translation>{name}：{crs} では、この場所の長さが実際の {scale:.5f} 倍になります。結果の長さも同じです。</translation>
    </message>
    <message>
        <source>{names} and {count} more</source>
        <translation>{names}ほか{count}件</translation>
    </message>
    <message>
        <source>{names} is in {crs}, but {others} in {crs_2}: results are in the system of the points; check that both are right.</source>
        <translation>{names}は{crs}、{others}は{crs_2}です。成果は点群の座標系になります。どちらも正しいか確認してください。</translation>
    </message>
    <message>
        <source>{one} has heights in {first}, but {other} in {second}: convert one of them with “Convert heights”, or give a geoid model.</source>
        <translation>{one}の高さは{first}、{other}の高さは{second}です。「高さの変換」でどちらかを変換するか、ジオイドモデルを指定してください。</translation>
    </message>
    <message>
        <source>{names}: not where the other files are ({distance} away): check coordinates and reference system.</source>
        <translation>{names}：ほかのファイルから{distance}離れています。座標と座標参照系を確認してください。</translation>
    </message>
    <message>
        <source>No point cloud was measured in the times of the trajectories ({trajectories}): give those of one survey.</source>
        <translation>走行軌跡（{trajectories}）の時刻に計測された点群がありません。同じ計測のものを指定してください。</translation>
    </message>
    <message>
        <source>{name} was observed at other times than the navigation files hold: fetch the navigation file of its day.</source>
        <translation>{name}の観測時刻は航法ファイルの時刻に含まれません。その日の航法ファイルを取得してください。</translation>
    </message>
    <message>
        <source>{names}: not named in the exterior orientation; left out.</source>
        <translation>{names}：外部標定要素に記載がないため使いません。</translation>
    </message>
    <message>
        <source>{names} has {size}, the camera {sizes}: give the camera of these frames.</source>
        <translation>{names}は{size}、カメラは{sizes}です。この写真のカメラを指定してください。</translation>
    </message>
    <message>
        <source>The exterior orientation names none of the {kind} ({names}): give the one of this flight.</source>
        <translation>外部標定要素に{kind}（{names}）の記載がありません。この撮影のものを指定してください。</translation>
    </message>
    <message>
        <source>{names}: nothing else was measured in these times; not used. Check whether it is of another day.</source>
        <translation>{names}：この時間帯に計測したデータがほかにないため、使用しません。別の日のものでないか確認してください。</translation>
    </message>
    <message>
        <source>Aerial reference: road markings and ground</source>
        <translation>空中写真による基準：路面標示と地盤高</translation>
    </message>
    <message>
        <source>Mobile survey laid on the reference</source>
        <translation>基準に合わせたMMS計測</translation>
    </message>
    <message>
        <source>Building models with measured walls</source>
        <translation>計測した壁面を用いた建物モデル</translation>
    </message>
    <message>
        <source>Map of the accuracy of localisation</source>
        <translation>自己位置推定精度の地図</translation>
    </message>
    <message>
        <source>Street objects: poles, signals, signs, trees</source>
        <translation>道路沿いの地物：柱・信号・標識・樹木</translation>
    </message>
    <message>
        <source>Road model of edges that the survey measured, step by step</source>
        <translation>MMS計測の道路縁による道路モデル（段階ごと）</translation>
    </message>
    <message>
        <source>Road space in one run: measured road model and street objects</source>
        <translation>道路空間（一括処理）：MMS計測による道路モデルと道路沿いの地物</translation>
    </message>
    <message>
        <source>Airborne laser points (LAS, LAZ) are missing: the surveying authority of the area has them; in Japan those of GSI and of the prefectures are at the G-Spatial Information Centre.</source>
        <translation>航空レーザ点群（LAS、LAZ）がありません。その地域の測量機関が提供しています。日本では国土地理院や都道府県のものがG空間情報センターにあります。</translation>
    </message>
    <message>
        <source>Building outlines are missing: in Japan download “outlines of buildings” (BldA) of GSI's Fundamental Geospatial Data; elsewhere take those of the cadastre or of OpenStreetMap.</source>
        <translation>建物外周線がありません。日本では国土地理院の基盤地図情報「建築物の外周線」（BldA）をダウンロードしてください。ほかの国では地籍やOpenStreetMapのものが使えます。</translation>
    </message>
    <message>
        <source>Aerial frames with camera and exterior orientation, or an orthophoto, are missing: ask who flew them for the frames as the camera took them (TIFF or JPEG).</source>
        <translation>空中写真（カメラと外部標定要素を含む）もオルソ画像もありません。撮影した会社から撮影したままの写真（TIFFまたはJPEG）を入手してください。</translation>
    </message>
    <message>
        <source>The camera file (JSON) of the frames is missing: write it from the camera's calibration certificate; the page on file formats has an example.</source>
        <translation>写真のカメラファイル（JSON）がありません。カメラの検定記録から作成してください。ファイル形式のページに例があります。</translation>
    </message>
    <message>
        <source>The exterior orientation of the frames is missing: export it from the aerial triangulation as a table with image, x, y, z, omega, phi, kappa.</source>
        <translation>写真の外部標定要素がありません。空中三角測量の成果から image, x, y, z, omega, phi, kappa の表として書き出してください。</translation>
    </message>
    <message>
        <source>A mobile survey with its trajectory is missing: export the points with GPS times (LAS, LAZ) and the trajectory of the same drive from the navigation software.</source>
        <translation>MMS計測とその走行軌跡がありません。GPS時刻付きの点群（LAS、LAZ）と、同じ走行の軌跡を航法解析ソフトウェアから書き出してください。</translation>
    </message>
    <message>
        <source>The calibration of the scanners (JSON) is missing: write it from the certificate of the vehicle; without it intensities are not made even over ranges.</source>
        <translation>スキャナの校正値（JSON）がありません。車両の検定記録から作成してください。ないと、距離による反射強度の補正を行いません。</translation>
    </message>
    <message>
        <source>No GNSS navigation file: accuracy is predicted from walls and markings alone; data centres of the IGS and GSI's GEONET have them by day.</source>
        <translation>GNSS航法ファイルがないため、壁面と路面標示だけから精度を予測します。航法ファイルはIGSのデータセンターや国土地理院のGEONETから日ごとに取得できます。</translation>
    </message>
    <message>
        <source>Edges or surfaces of roads are missing: give lines along both edges (in Japan RdEdg of GSI's Fundamental Geospatial Data, opened in QGIS and saved in a projected system), or the surfaces of an older road model.</source>
        <translation>道路縁または道路面がありません。道路の両側の線（日本では基盤地図情報の道路縁 RdEdg を QGIS で開き、投影座標系で保存したもの）か、以前の道路モデルの面を指定してください。</translation>
    </message>
    <message>
        <source>The markings given are the reference; leave them out to make it from the images.</source>
        <translation>指定した路面標示を基準にします。画像から作成する場合は、それを外してください。</translation>
    </message>
    <message>
        <source>The frames are corrected by the points measured in them; leave these out to take the orientation as it is.</source>
        <translation>写真の外部標定要素を、写真上で測定した点で補正します。そのまま使う場合は、それらの点を外してください。</translation>
    </message>
    <message>
        <source>The airborne points are shifted to the control points given for them; leave these out to take the points as they are.</source>
        <translation>航空レーザ点群を、指定した調整点に合わせて平行移動します。そのまま使う場合は、調整点を外してください。</translation>
    </message>
    <message>
        <source>{part} count in degrees: open the layer in QGIS, save it with “Export” in {crs}, and add that file.</source>
        <translation>{part}が度単位です。QGISでレイヤを開き、「エクスポート」で {crs} に保存して、そのファイルを追加してください。</translation>
    </message>
    <message>
        <source>No file states the reference system of the points: say it in the settings of the step (“{label}”).</source>
        <translation>点群の座標参照系がどのファイルにも書かれていません。ステップの設定（「{label}」）で指定してください。</translation>
    </message>
    <message>
        <source>Markings as polygons are missing: a mask alone makes no lane map; leave it out to make both from the images.</source>
        <translation>路面標示のポリゴンがありません。マスクだけでは車線地図を作成できません。マスクを外すと、両方を画像から作成します。</translation>
    </message>
    <message>
        <source>There is nothing to lay the survey on, so that it is taken as it is, and objects are as wrong as it is: say how well it is placed in the settings of the step (“{label}”).</source>
        <translation>位置合わせの基準がないため、点群はそのまま使います。地物の位置の誤差は点群の誤差と同じになります。手順の設定（「{label}」）で点群の位置の精度を指定してください。</translation>
    </message>
    <message>
        <source>Survey {number}: no control points measured in its times are given, so that its accuracy is not checked independently.</source>
        <translation>計測{number}：計測時間内の検証点がないため、精度を独立に点検できません。</translation>
    </message>
    <message>
        <source>the plane reference system of the points</source>
        <translation>点群の平面座標系</translation>
    </message>
    <message>
        <source>Points as text</source>
        <translation>テキスト形式の点群</translation>
    </message>
    <message>
        <source>Line scans</source>
        <translation>ラインスキャン</translation>
    </message>
    <message>
        <source>Aerial frame</source>
        <translation>空中写真</translation>
    </message>
    <message>
        <source>Line image</source>
        <translation>ライン画像</translation>
    </message>
    <message>
        <source>Mask of an image</source>
        <translation>画像のマスク</translation>
    </message>
    <message>
        <source>Elevation raster</source>
        <translation>標高ラスタ</translation>
    </message>
    <message>
        <source>Raster of another kind</source>
        <translation>その他のラスタ</translation>
    </message>
    <message>
        <source>Control points of a point cloud</source>
        <translation>点群の調整点</translation>
    </message>
    <message>
        <source>Points in frames</source>
        <translation>写真上の点</translation>
    </message>
    <message>
        <source>Times of a line image</source>
        <translation>ライン画像の時刻</translation>
    </message>
    <message>
        <source>Building outlines (GSI)</source>
        <translation>建物外周線（国土地理院）</translation>
    </message>
    <message>
        <source>Elevation model (GSI)</source>
        <translation>数値標高モデル（国土地理院）</translation>
    </message>
    <message>
        <source>Other objects (GSI)</source>
        <translation>その他の地物（国土地理院）</translation>
    </message>
    <message>
        <source>Road edges or surfaces</source>
        <translation>道路縁または道路面</translation>
    </message>
    <message>
        <source>Areas of another kind</source>
        <translation>その他のポリゴン</translation>
    </message>
    <message>
        <source>Points of a layer</source>
        <translation>点レイヤ</translation>
    </message>
    <message>
        <source>GNSS navigation</source>
        <translation>GNSS航法ファイル</translation>
    </message>
    <message>
        <source>GNSS orbits</source>
        <translation>GNSS軌道</translation>
    </message>
    <message>
        <source>UrbanMap job</source>
        <translation>UrbanMapの作業</translation>
    </message>
    <message>
        <source>Table of another kind</source>
        <translation>その他の表</translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation>メッシュ</translation>
    </message>
    <message>
        <source>Texture of a model</source>
        <translation>モデルのテクスチャ</translation>
    </message>
    <message>
        <source>Of no known use</source>
        <translation>用途不明</translation>
    </message>
    <message>
        <source>{name} states no coordinate reference system: say it where it is used.</source>
        <translation>{name}に座標参照系の記載がありません。使うところで指定してください。</translation>
    </message>
    <message>
        <source>The job has no step “{step}”; it has {known}.</source>
        <translation>作業に手順「{step}」はありません。あるのは{known}です。</translation>
    </message>
    <message>
        <source>{name} is no UrbanMap job: choose a file that the dock has saved.</source>
        <translation>{name}はUrbanMapの作業ファイルではありません。パネルで保存したファイルを選んでください。</translation>
    </message>
    <message>
        <source>{name} was written by a later version of UrbanMap: update the plugin.</source>
        <translation>{name}はより新しいUrbanMapで作成されています。プラグインを更新してください。</translation>
    </message>
    <message>
        <source>{name} has the step “{step}” twice: give each its own name.</source>
        <translation>{name}に手順「{step}」が2つあります。別々の名前にしてください。</translation>
    </message>
    <message>
        <source>The job has no input “{role}”; it has {known}.</source>
        <translation>作業に入力「{role}」はありません。あるのは{known}です。</translation>
    </message>
    <message>
        <source>step {number}</source>
        <translation>手順 {number}</translation>
    </message>
    <message>
        <source>Step “{step}”: the job has no input “{role}”; add the file.</source>
        <translation>手順「{step}」：作業に入力「{role}」がありません。ファイルを追加してください。</translation>
    </message>
    <message>
        <source>Step “{step}” needs {output} of step “{before}”, which gave none: say it in the settings of the step.</source>
        <translation>手順「{step}」には手順「{before}」の {output} が必要ですが、得られていません。手順の設定で指定してください。</translation>
    </message>
    <message>
        <source>Step “{step}” needs what “{before}” makes: run that step first.</source>
        <translation>手順「{step}」には「{before}」の結果が必要です。先にその手順を実行してください。</translation>
    </message>
    <message>
        <source>to run</source>
        <translation>未実行</translation>
    </message>
    <message>
        <source>done</source>
        <translation>完了</translation>
    </message>
    <message>
        <source>error</source>
        <translation>エラー</translation>
    </message>
    <message>
        <source>Job: {wish}</source>
        <translation>作業：{wish}</translation>
    </message>
    <message>
        <source>Inputs</source>
        <translation>入力</translation>
    </message>
    <message>
        <source>All steps are done, and no report finds fault.</source>
        <translation>すべての手順が完了し、どのレポートにも問題はありません。</translation>
    </message>
    <message>
        <source>Step</source>
        <translation>手順</translation>
    </message>
    <message>
        <source>State</source>
        <translation>状態</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>秒</translation>
    </message>
    <message>
        <source>Part</source>
        <translation>役割</translation>
    </message>
    <message>
        <source>Step “{step}” failed: {message}</source>
        <translation>手順「{step}」が失敗しました：{message}</translation>
    </message>
    <message>
        <source>{waiting} of {count} steps have not run yet.</source>
        <translation>{count}手順のうち{waiting}手順が未実行です。</translation>
    </message>
    <message>
        <source>All steps are done; none of them judges its result: look at the layers.</source>
        <translation>すべての手順が完了しました。結果を判定する手順はないため、レイヤを確認してください。</translation>
    </message>
    <message>
        <source>{step}: {verdict}</source>
        <translation>{step}：{verdict}</translation>
    </message>
    <message>
        <source>format {format}, {density:.1f} points/m²</source>
        <translation>形式{format}、{density:.1f} 点/m²</translation>
    </message>
    <message>
        <source>{name} says where it lies in numbers that are not finite: it is damaged; copy or download it again.</source>
        <translation>{name} の位置を示す数が有限ではありません。壊れていますので、コピーまたはダウンロードし直してください。</translation>
    </message>
    <message>
        <source>{name} ends in {suffix}, but its content is that of {usual}: rename it, as some programs go by the name.</source>
        <translation>{name}の拡張子は{suffix}ですが、内容は{usual}です。名前で判断するプログラムもあるため、名前を変更してください。</translation>
    </message>
    <message>
        <source>{name} is empty: copy or download it again.</source>
        <translation>{name}は空です。コピーまたはダウンロードし直してください。</translation>
    </message>
    <message>
        <source>{name} does not begin as a file of this name's ending does: it is damaged or of another kind; copy or download it again.</source>
        <translation>{name}の先頭は、この拡張子のファイルのものではありません。破損しているか別の種類です。コピーまたはダウンロードし直してください。</translation>
    </message>
    <message>
        <source>packed</source>
        <translation>圧縮ファイル</translation>
    </message>
    <message>
        <source>{name} cannot be read ({error}): it is damaged or of another kind.</source>
        <translation>{name}を読み込めません（{error}）。破損しているか別の種類です。</translation>
    </message>
    <message>
        <source>{name} holds no epoch of observations: it is cut off or damaged; fetch it again.</source>
        <translation>{name}に観測エポックがありません。途中で切れているか破損しています。取得し直してください。</translation>
    </message>
    <message>
        <source>{width} x {height} pixels</source>
        <translation>{width} x {height} 画素</translation>
    </message>
    <message>
        <source>{scanners} scanners, {cameras} cameras</source>
        <translation>スキャナ{scanners}台、カメラ{cameras}台</translation>
    </message>
    <message>
        <source>{name} counts in degrees: open it in QGIS, save it with “Export” in the plane reference system of the points, and add that file.</source>
        <translation>{name} は度単位です。QGISで開き、「エクスポート」で点群と同じ平面座標系に保存して、そのファイルを追加してください。</translation>
    </message>
    <message>
        <source>{name} holds a path without roll, pitch and heading, which is no trajectory: export the trajectory from the navigation software as text or SBET.</source>
        <translation>{name} はロール、ピッチ、ヘディングのない経路で、走行軌跡ではありません。航法解析ソフトウェアから軌跡をテキストまたはSBETで書き出してください。</translation>
    </message>
    <message>
        <source>{name} holds places without the times at which the survey passed them: write control points as a table with id, x, y, z, time, x_mms, y_mms, z_mms.</source>
        <translation>{name} の位置には計測車が通過した時刻がありません。基準点は列 id、x、y、z、time、x_mms、y_mms、z_mms の表にしてください。</translation>
    </message>
    <message>
        <source>{name} holds areas that look like no buildings: where they are, say that they are used as building outlines.</source>
        <translation>{name} の範囲は建物らしくありません。建物の場合は、用途を建物外周に指定してください。</translation>
    </message>
    <message>
        <source>{name} has coordinates that are no longitude and latitude: KML counts in degrees, longitude first; export it again.</source>
        <translation>{name} の座標は経度・緯度ではありません。KMLは度単位で経度が先です。出力し直してください。</translation>
    </message>
    <message>
        <source>{name} has coordinates that are no numbers: it is damaged; save it again.</source>
        <translation>{name} の座標に数値でないものがあります。壊れています。保存し直してください。</translation>
    </message>
    <message>
        <source>{name} is cut off: its end is missing; copy or download it again.</source>
        <translation>{name}は途中で切れています（終わりがありません）。コピーまたはダウンロードし直してください。</translation>
    </message>
    <message>
        <source>{name} holds links or pictures only: open it in the program that it comes from and save the places themselves.</source>
        <translation>{name} にはリンクか画像しかありません。作成したソフトウェアで開き、位置そのものを保存してください。</translation>
    </message>
    <message>
        <source>{name} holds no feature: choose another file.</source>
        <translation>{name}に地物がありません。別のファイルを選んでください。</translation>
    </message>
    <message>
        <source>told by the size of its polygons (median {area:.1f} m²), not by a name</source>
        <translation>名前ではなくポリゴンの大きさ（中央値 {area:.1f} m²）から判定</translation>
    </message>
    <message>
        <source>of one band</source>
        <translation>1バンド</translation>
    </message>
    <message>
        <source>told by the {share:.1f} % of it that are set</source>
        <translation>値のある画素が{share:.1f} %であることから判定</translation>
    </message>
    <message>
        <source>{name} cannot be read as an image or raster: it is damaged or cut off; copy or download it again.</source>
        <translation>{name}を画像またはラスタとして読み込めません。破損しているか途中で切れています。コピーまたはダウンロードし直してください。</translation>
    </message>
    <message>
        <source>told by its decimal numbers</source>
        <translation>小数の値であることから判定</translation>
    </message>
    <message>
        <source>{path} is no SBET file or is cut off: its length is no multiple of {itemsize} bytes.</source>
        <translation>{path}はSBETファイルではないか、途中で切れています。長さが {itemsize} バイトの倍数ではありません。</translation>
    </message>
    <message>
        <source>{name} holds an SBET: let its name end in .out or .sbet, by which it is read.</source>
        <translation>{name}の内容はSBETです。読み込むには名前の末尾を.outまたは.sbetにしてください。</translation>
    </message>
    <message>
        <source>{name} has its places in latitude and longitude: read it by “Import table…” in the menu UrbanMap, which lays them into the plane reference system of the survey.</source>
        <translation>{name}の位置は緯度・経度です。メニュー「UrbanMap」の「表の取り込み…」で、計測の平面座標系に変換して読み込んでください。</translation>
    </message>
    <message>
        <source>{name} says of no point where it lies in a cloud or what its role is.</source>
        <translation>{name} には、点群内での位置も役割も書かれた点がありません。</translation>
    </message>
    <message>
        <source>told by its rows of three numbers or more</source>
        <translation>3つ以上の数値の行から判定</translation>
    </message>
    <message>
        <source>{name} holds points as text: convert them to LAS or LAZ to use them.</source>
        <translation>{name}はテキスト形式の点群です。使うにはLASまたはLAZに変換してください。</translation>
    </message>
    <message>
        <source>{name} holds no layer: export it again.</source>
        <translation>{name}にレイヤがありません。書き出し直してください。</translation>
    </message>
    <message>
        <source>{name} is cut off: copy or download it again.</source>
        <translation>{name}は途中で切れています。コピーまたはダウンロードし直してください。</translation>
    </message>
    <message>
        <source>{name} is cut off: it says that it has {said} bytes, but has {bytes}; copy or download it again.</source>
        <translation>{name}は途中で切れています（{said}バイトのはずが{bytes}バイト）。コピーまたはダウンロードし直してください。</translation>
    </message>
    <message>
        <source>{name} cannot be read as a GeoPackage ({error}): it is damaged or cut off; copy or export it again.</source>
        <translation>{name}をGeoPackageとして読み込めません（{error}）。破損しているか途中で切れています。コピーまたは書き出し直してください。</translation>
    </message>
    <message>
        <source>{name} has a polygon with corners that are no numbers: it is damaged; copy or export it again.</source>
        <translation>{name} に座標が数でないポリゴンがあります。壊れていますので、コピーまたは出力し直してください。</translation>
    </message>
    <message>
        <source>{name} lies alone: put its .dbf and .shx beside it.</source>
        <translation>{name}だけがあります。.dbfと.shxを同じフォルダに置いてください。</translation>
    </message>
    <message>
        <source>{name} is a database but no GeoPackage: export its layers to a GeoPackage.</source>
        <translation>{name}はデータベースですがGeoPackageではありません。レイヤをGeoPackageに書き出してください。</translation>
    </message>
    <message>
        <source>CityGML without buildings</source>
        <translation>建物のないCityGML</translation>
    </message>
    <message>
        <source>{name} is no XML: it is damaged; copy or download it again.</source>
        <translation>{name}はXMLではありません。破損しています。コピーまたはダウンロードし直してください。</translation>
    </message>
    <message>
        <source>{name} is not a sound zip file: fetch it again.</source>
        <translation>{name}は正しいzipファイルではありません。取得し直してください。</translation>
    </message>
    <message>
        <source>{count} files</source>
        <translation>{count}ファイル</translation>
    </message>
    <message>
        <source>zips in a zip</source>
        <translation>zipの中のzip</translation>
    </message>
    <message>
        <source>told by the names in it</source>
        <translation>中のファイル名から判定</translation>
    </message>
    <message>
        <source>Control points of the airborne points</source>
        <translation>航空レーザ点群の調整点</translation>
    </message>
    <message>
        <source>Control points of the frames</source>
        <translation>写真の標定点</translation>
    </message>
    <message>
        <source>{name} is used as a mobile survey, but no trajectory covers its times: add that of the same drive.</source>
        <translation>{name} をMMS計測として使いますが、その時刻の走行軌跡がありません。同じ走行の軌跡を追加してください。</translation>
    </message>
    <message>
        <source>{kind}: {count} files could be taken ({names}); the first is. Say of another one that it is used as that, or untick the first.</source>
        <translation>{kind}：{count}個のファイルが候補です（{names}）。最初のものを使います。別のものを使うときは、その用途を指定するか、最初のもののチェックを外してください。</translation>
    </message>
    <message>
        <source>{one} and {other} hold the same points: only the first is taken.</source>
        <translation>{one}と{other}は同じ点群です。最初のものだけを使います。</translation>
    </message>
    <message>
        <source>{count} trajectories cover the times of {name}: {drive}, which lies nearest to it, is taken.</source>
        <translation>{name}の時刻を含む走行軌跡が{count}個あります。最も近い場所にある{drive}を使います。</translation>
    </message>
    <message>
        <source>{north} is taken as counting north and {east} as counting east; the table does not say it. In the Japanese plane rectangular system X counts north; where X counts east, swap the two above the columns.</source>
        <translation>{north}を北方向、{east}を東方向とみなしています。表には書かれていません。平面直角座標系ではXが北方向です。Xが東方向の場合は、列の上の選択を入れ替えてください。</translation>
    </message>
    <message>
        <source>{name}: ellipsoidal heights were lowered by {min:.3f} to {max:.3f} m to heights above the geoid ({geoid}).</source>
        <translation>{name}：楕円体高を {min:.3f}～{max:.3f} m 下げてジオイドからの高さにしました（{geoid}）。</translation>
    </message>
    <message>
        <source>{name} has no latitude and longitude in the columns chosen: choose other columns.</source>
        <translation>{name}：選んだ列に緯度・経度がありません。別の列を選んでください。</translation>
    </message>
    <message>
        <source>{name}: latitudes and longitudes were laid into {crs}.</source>
        <translation>{name}：緯度・経度を {crs} に投影しました。</translation>
    </message>
    <message>
        <source>{name}: heights stay above the ellipsoid: points and reference must have such heights too; otherwise give a geoid model.</source>
        <translation>{name}：高さは楕円体高のままです。点群と基準も楕円体高でなければなりません。そうでない場合はジオイドモデルを指定してください。</translation>
    </message>
    <message>
        <source>{name} has no more than {skip} lines: leave fewer out.</source>
        <translation>{name}は{skip}行以下です。飛ばす行を減らしてください。</translation>
    </message>
    <message>
        <source>No column is chosen for {missing}: choose one.</source>
        <translation>{missing}の列が選ばれていません。選んでください。</translation>
    </message>
    <message>
        <source>Say what the heights count from: the ellipsoid, as GNSS measures them, or sea level.</source>
        <translation>高さの基準を指定してください。楕円体（GNSSの測定値のまま）か、標高です。</translation>
    </message>
    <message>
        <source>{name} has no row with numbers in the columns chosen: choose other columns, or another delimiter.</source>
        <translation>{name}には、選んだ列に数値のある行がありません。別の列か別の区切り文字を選んでください。</translation>
    </message>
    <message>
        <source>{name}: row {number} has {count} values, fewer than the columns chosen: the delimiter may be another one, or the file is cut off.</source>
        <translation>{name}：{number}行目の値は{count}個で、選んだ列より少なくなっています。区切り文字が違うか、ファイルが途中で切れています。</translation>
    </message>
    <message>
        <source>{name}: row {number} has no latitude and longitude: correct or remove it.</source>
        <translation>{name}：{number}行目に緯度・経度がありません。修正するか削除してください。</translation>
    </message>
    <message>
        <source>{name}: the height of line {number} of the values is no number: correct or remove it.</source>
        <translation>{name}：値の{number}行目の高さが数値ではありません。修正するか削除してください。</translation>
    </message>
    <message>
        <source>{name} holds no ways of reading tables: delete it.</source>
        <translation>{name}に表の読み込み方の記録がありません。削除してください。</translation>
    </message>
    <message>
        <source>The places do not lie in {crs}: choose the system of the survey, or swap latitude and longitude.</source>
        <translation>位置が {crs} の範囲にありません。計測の座標系を選ぶか、緯度と経度を入れ替えてください。</translation>
    </message>
    <message>
        <source>The table</source>
        <translation>表</translation>
    </message>
    <message>
        <source>A latitude is beyond 90°, or a longitude beyond 360°: choose other columns.</source>
        <translation>緯度が90°、または経度が360°を超えています。別の列を選んでください。</translation>
    </message>
    <message>
        <source>markings</source>
        <translation>路面標示</translation>
    </message>
    <message>
        <source>satellites</source>
        <translation>衛星</translation>
    </message>
    <message>
        <source>together</source>
        <translation>全体</translation>
    </message>
    <message>
        <source>good</source>
        <translation>良好</translation>
    </message>
    <message>
        <source>usable</source>
        <translation>使用可</translation>
    </message>
    <message>
        <source>poor</source>
        <translation>不良</translation>
    </message>
    <message>
        <source>none</source>
        <translation>判定不能</translation>
    </message>
    <message>
        <source>The roads have no length: give lines along which vehicles drive.</source>
        <translation>道路の長さがありません。車両が走行する線を指定してください。</translation>
    </message>
    <message>
        <source>The trajectory does not move: give that of a drive.</source>
        <translation>軌跡が移動していません。走行の軌跡を指定してください。</translation>
    </message>
    <message>
        <source>More than {most_places:,} places: choose a larger spacing or fewer roads.</source>
        <translation>地点が {most_places:,} を超えます。間隔を広げるか、道路を減らしてください。</translation>
    </message>
    <message>
        <source>observed, m</source>
        <translation>観測値 (m)</translation>
    </message>
    <message>
        <source>{place}: street {street}, from {min:.0f} m. Ellipses five times enlarged.</source>
        <translation>{place}: 道路 {street}、{min:.0f} m から。楕円は5倍に拡大しています。</translation>
    </message>
    <message>
        <source>{place}: about east {east:.0f} m, north {north:.0f} m. Ellipses five times enlarged.</source>
        <translation>{place}：東 {east:.0f} m、北 {north:.0f} m 付近。楕円は 5 倍に拡大。</translation>
    </message>
    <message>
        <source>On {mean:.0%} of the places the map tells where a vehicle is, with a median sigma of {median:.2f} m in the weakest direction; the worst stretches are below.</source>
        <translation>地点の {mean:.0%} で、地図から車両の位置を推定できます。最も弱い方向のσの中央値は {median:.2f} m です。最も精度の低い区間を以下に示します。</translation>
    </message>
    <message>
        <source>east, m</source>
        <translation>東座標 (m)</translation>
    </message>
    <message>
        <source>north, m</source>
        <translation>北座標 (m)</translation>
    </message>
    <message>
        <source>places</source>
        <translation>箇所数</translation>
    </message>
    <message>
        <source>street</source>
        <translation>街路</translation>
    </message>
    <message>
        <source>from, m</source>
        <translation>始点 (m)</translation>
    </message>
    <message>
        <source>to, m</source>
        <translation>終点 (m)</translation>
    </message>
    <message>
        <source>Of {without_count} stretches nothing can be said: see the statuses above and the layer.</source>
        <translation>{without_count} 区間については評価できません。上の状態の表とレイヤを参照してください。</translation>
    </message>
    <message>
        <source>{control_count} control points. An error is where the survey has a point less where it truly is.</source>
        <translation>検証点は {control_count} 点です。誤差は、計測データ上の位置から真の位置を引いた値です。</translation>
    </message>
    <message>
        <source>{name}: {mean_2d:.1f} cm off in plan on average and {max_2d:.1f} cm at most, at {control_count} control points. Compare this with what the job asks for; the worst points are below.</source>
        <translation>{name}: 検証点 {control_count} 点での水平誤差は平均 {mean_2d:.1f} cm、最大 {max_2d:.1f} cm です。業務で求められる精度と比較してください。誤差の大きい点を以下に示します。</translation>
    </message>
    <message>
        <source>Horizontal errors, {name}</source>
        <translation>水平誤差（{name}）</translation>
    </message>
    <message>
        <source>The worst control points, {name}</source>
        <translation>誤差の大きい検証点（{name}）</translation>
    </message>
    <message>
        <source>{left_out} control points were not measured during this survey and are left out.</source>
        <translation>検証点 {left_out} 点はこの計測の時間内に計測されていないため、除外しました。</translation>
    </message>
    <message>
        <source>Horizontal error of each control point. Points that stand out alone hint at the control; errors that grow with time, at a part that is not corrected.</source>
        <translation>各検証点の水平誤差。単独で外れる点は検証点の誤り、時間とともに増える誤差は補正されていない部分を示します。</translation>
    </message>
    <message>
        <source>Control point {name} was measured by none of the drives: no trajectory passes within {control_reach:.0f} m of it at its time.</source>
        <translation>基準点{name}はどの走行でも計測されていません。その時刻に {control_reach:.0f} m 以内を通る軌跡がありません。</translation>
    </message>
    <message>
        <source>{paths} belongs to none of the trajectories: none covers its GPS times near its points. Give the trajectory of each drive.</source>
        <translation>{paths}に対応する軌跡がありません。点の近くでそのGPS時刻を含む軌跡がないためです。各走行の軌跡を指定してください。</translation>
    </message>
    <message>
        <source>No point cloud was measured along {name}: give the points of each drive.</source>
        <translation>{name}に沿って計測された点群がありません。各走行の点群を指定してください。</translation>
    </message>
    <message>
        <source>Adjusting {drives_count} drives with {observations_count} observations.</source>
        <translation>{observations_count} 個の観測値により {drives_count} 走行を調整しています。</translation>
    </message>
    <message>
        <source>Ties change by more than drift within 20 m (a step of a trajectory): {stepped} may step there, and control or reference says which does.</source>
        <translation>20 m 以内で走行間のずれがドリフトを超えて変化しています（軌跡の段差）。段差がある可能性のある走行は{stepped}で、どれであるかは基準点または基準データで決まります。</translation>
    </message>
    <message>
        <source>No control point or reference marking fixes {relative}: these drives agree with each other, but their place is only relative.</source>
        <translation>{relative}を固定する基準点や基準の路面標示がありません。これらの走行は互いに整合していますが、位置は相対的なものです。</translation>
    </message>
    <message>
        <source>Nothing ties {loose} to anything: it stays as reported.</source>
        <translation>{loose}には結合する観測値がないため、補正前のままとします。</translation>
    </message>
    <message>
        <source>{count} observations ({name}), {lost} without weight; RMS residual {plan:.1f} cm in plan, {up:.1f} cm in height.</source>
        <translation>観測値 {count} 個（{name}）、うち重みなし {lost} 個。RMS残差は水平 {plan:.1f} cm、高さ {up:.1f} cm です。</translation>
    </message>
    <message>
        <source>{count} observations ({name}), {lost} without weight; RMS residual {plan:.1f} cm in plan.</source>
        <translation>観測値 {count} 個（{name}）、うち重みなし {lost} 個。RMS残差は水平 {plan:.1f} cm です。</translation>
    </message>
    <message>
        <source>control point</source>
        <translation>基準点（調整点・検証点）</translation>
    </message>
    <message>
        <source>reference marking</source>
        <translation>基準の路面標示</translation>
    </message>
    <message>
        <source>Looking for planes that drives share.</source>
        <translation>走行間で共通する平面を探しています。</translation>
    </message>
    <message>
        <source>Correction along the path. Look for steps that no loss of satellites explains.</source>
        <translation>経路に沿った補正量。衛星の喪失では説明できない段差を探してください。</translation>
    </message>
    <message>
        <source>Standard deviation of the correction. It grows away from ties and control.</source>
        <translation>補正量の標準偏差。結合や基準から離れるほど大きくなります。</translation>
    </message>
    <message>
        <source>The drives are placed with a standard deviation of {sigma:.1f} cm in plan (median; largest {max:.0f} cm).</source>
        <translation>走行の水平位置の標準偏差は {sigma:.1f} cm です（中央値、最大 {max:.0f} cm）。</translation>
    </message>
    <message>
        <source>{drive} shares no markings with other drives, control or reference: it stays as reported.</source>
        <translation>{drive}には、他の走行、基準点、基準データと共通する路面標示がないため、補正前のままとします。</translation>
    </message>
    <message>
        <source>up</source>
        <translation>高さ</translation>
    </message>
    <message>
        <source>Looking for markings that drives share.</source>
        <translation>走行間で共通する路面標示を探しています。</translation>
    </message>
    <message>
        <source>The drives share no markings and planes, and no control point or reference marking fits them: nothing can be adjusted.</source>
        <translation>走行間で共通する路面標示や平面がなく、整合する基準点や基準の路面標示もないため、調整できません。</translation>
    </message>
    <message>
        <source>No marking of {drive} could be registered to the reference markings.</source>
        <translation>{drive}の路面標示は、基準の路面標示に位置合わせできませんでした。</translation>
    </message>
    <message>
        <source>Looking for facades on the walls of buildings.</source>
        <translation>建物の壁に当たる壁面を探しています。</translation>
    </message>
    <message>
        <source>Facades stand {eaves:.2f} m inside the outlines in the mean, and differ from it by {differ:.2f} m.</source>
        <translation>壁面は外周線より平均 {eaves:.2f} m 内側にあり、個々の壁のばらつきは {differ:.2f} m です。</translation>
    </message>
    <message>
        <source>The drives show no facade near the vehicle: give all their points, not the markings alone, or adjust them without buildings.</source>
        <translation>計測点群の車両付近に壁面がありません。標示だけでなく全点を指定するか、建物を使わずに調整してください。</translation>
    </message>
    <message>
        <source>No wall of the airborne laser points beside {drives}: the other drives' walls are used.</source>
        <translation>{drives} のそばには航空レーザ点群の壁がありません。他の走行で見つかった壁を使います。</translation>
    </message>
    <message>
        <source>No facade of the drives belongs to a building, and nothing else ties them: check that buildings and drives show the same streets.</source>
        <translation>建物に対応する壁面がなく、ほかに走行を結び付けるものもありません。建物と走行が同じ街路を示すことを確認してください。</translation>
    </message>
    <message>
        <source>{output} must end in .laz or .las.</source>
        <translation>{output}の拡張子は .laz または .las にしてください。</translation>
    </message>
    <message>
        <source>{path}: no image was taken between {start:.1f} and {end:.1f} s, the time of the trajectory: give the poses of this survey.</source>
        <translation>{path}: 軌跡の時間 {start:.1f}～{end:.1f} s に撮影された画像がありません。この計測の位置姿勢を指定してください。</translation>
    </message>
    <message>
        <source>{away_count:,} of {away_count_2:,} images were taken outside the trajectory's time: they were moved with its nearest pose.</source>
        <translation>{away_count_2:,} 枚の画像のうち {away_count:,} 枚は軌跡の時間外に撮影されたため、最も近い時刻の位置姿勢で移動しました。</translation>
    </message>
    <message>
        <source>moved with its nearest pose</source>
        <translation>最も近い姿勢とともに移動しました</translation>
    </message>
    <message>
        <source>left where they were</source>
        <translation>元の位置のままです</translation>
    </message>
    <message>
        <source>{outside:,} of {points:,} points were measured outside the trajectory's time: they were {done} and are not to be trusted.</source>
        <translation>{points:,} 点のうち {outside:,} 点は軌跡の時間外に計測されたもので（処理: {done}）、信頼できません。</translation>
    </message>
    <message>
        <source>{in_gaps:,} of {points:,} points were measured in gaps of the trajectory: they were moved by what lies between the gap's ends and are not to be trusted.</source>
        <translation>{points:,} 点のうち {in_gaps:,} 点は軌跡の欠測区間で計測されたもので、欠測区間の両端の間を補間して移動しました。信頼できません。</translation>
    </message>
    <message>
        <source>No point was measured during the trajectory: give those of one survey.</source>
        <translation>軌跡の時間内に計測された点がありません。同じ計測のものを指定してください。</translation>
    </message>
    <message>
        <source>{paths} is too wide for coordinates in steps of {min:g} m: store it in tiles or with a coarser step.</source>
        <translation>{paths}は {min:g} m 刻みの座標で表すには範囲が広すぎます。タイルに分けるか、刻みを粗くして保存してください。</translation>
    </message>
    <message>
        <source>The coordinates are stored in steps of {max:g} m, too coarse for the correction: they are written in steps of {coarsest_scale:g} m.</source>
        <translation>座標の刻み {max:g} m は補正に対して粗すぎるため、{coarsest_scale:g} m 刻みで書き出します。</translation>
    </message>
    <message>
        <source>Points were measured at {time:.3f} s, outside the trajectory ({time_2:.3f} to {time_3:.3f} s): give the trajectory of the whole survey, or let them be moved with the nearest pose.</source>
        <translation>軌跡（{time_2:.3f}～{time_3:.3f} s）の範囲外の {time:.3f} s に計測された点があります。計測全体の軌跡を与えるか、最も近い時刻の位置姿勢で移動する設定にしてください。</translation>
    </message>
    <message>
        <source>A point lies outside the bounds that the header of its file states: repair the header (lasinfo -repair).</source>
        <translation>ファイルのヘッダに記載された範囲の外に点があります。ヘッダを修復してください（lasinfo -repair）。</translation>
    </message>
    <message>
        <source>forward</source>
        <translation>前方</translation>
    </message>
    <message>
        <source>right</source>
        <translation>右</translation>
    </message>
    <message>
        <source>down</source>
        <translation>下方</translation>
    </message>
    <message>
        <source>roll</source>
        <translation>ロール</translation>
    </message>
    <message>
        <source>pitch</source>
        <translation>ピッチ</translation>
    </message>
    <message>
        <source>heading</source>
        <translation>ヘディング</translation>
    </message>
    <message>
        <source>{determined} of {total} values are determined and corrected; the others keep the values of the file.</source>
        <translation>{total} 個中 {determined} 個の値を決定して補正しました。残りはファイルの値のままです。</translation>
    </message>
    <message>
        <source>Planes seen twice lie {before:.1f} mm apart before and {after:.1f} mm after.</source>
        <translation>二度見た平面のずれは補正前 {before:.1f} mm、補正後 {after:.1f} mm です。</translation>
    </message>
    <message>
        <source>Drives in both directions and past walls at several angles determine more.</source>
        <translation>両方向の走行や、さまざまな向きの壁の横の走行があると、より多く決定できます。</translation>
    </message>
    <message>
        <source>{patches_count:,} planes in {first_pass} passes.</source>
        <translation>{first_pass} 走行パスの平面 {patches_count:,} 面。</translation>
    </message>
    <message>
        <source>{pairs:,} pairs of planes; they lie {rms_before:.1f} mm apart before and {rms_after:.1f} mm after (RMS).</source>
        <translation>平面の組は {pairs:,} 組で、その間隔は調整前 {rms_before:.1f} mm、調整後 {rms_after:.1f} mm です（RMS）。</translation>
    </message>
    <message>
        <source>The calibration holds no scanner: there is nothing to calibrate.</source>
        <translation>校正値にスキャナがありません。校正する対象がありません。</translation>
    </message>
    <message>
        <source>Only {pairs} planes were seen by two scanners or in two passes: drive a street with walls in both directions.</source>
        <translation>2台のスキャナまたは2つの走行パスで計測された平面が {pairs} 面しかありません。壁面のある道路を両方向に走行してください。</translation>
    </message>
    <message>
        <source>The passes lie {apart:.1f} m apart: correct the trajectories first (“Adjust several drives”) and place the points with them (“Apply corrected trajectory”).</source>
        <translation>走行パスどうしが {apart:.1f} m 離れています。先に軌跡を補正し（「複数走行の調整」）、それを用いて点を配置してください（「補正軌跡の適用」）。</translation>
    </message>
    <message>
        <source>Nothing is determined: the calibration stays as it is. Drive a street with walls in both directions, and correct the trajectories first.</source>
        <translation>何も決定できないため、校正値は変更しません。壁面のある道路を両方向に走行し、先に軌跡を補正してください。</translation>
    </message>
    <message>
        <source>determined</source>
        <translation>決定</translation>
    </message>
    <message>
        <source>not determined</source>
        <translation>決定できない</translation>
    </message>
    <message>
        <source>The calibration has no scanner with point source id {point_source_id} (it has: {known}): add it, or choose the calibration of this survey.</source>
        <translation>校正値に point source id が {point_source_id} のスキャナがありません（記載: {known}）。追加するか、この計測の校正値を選択してください。</translation>
    </message>
    <message>
        <source>{name} is no calibration: it needs an entry “scanners” or “cameras”.</source>
        <translation>{name}は校正値ではありません。項目「scanners」または「cameras」が必要です。</translation>
    </message>
    <message>
        <source>{name}: scanners and cameras must be lists of objects.</source>
        <translation>{name}: scanners と cameras はオブジェクトのリストにしてください。</translation>
    </message>
    <message>
        <source>{name}: “lever_arm_m” of {value} must be three numbers, metres forward, right and down.</source>
        <translation>{name}: {value}の「lever_arm_m」は、前方、右方、下方のメートル単位の3つの数値にしてください。</translation>
    </message>
    <message>
        <source>{name}: the lever arm of {value} is {max:.0f} m long; it must be in metres.</source>
        <translation>{name}: {value}のレバーアームの長さが {max:.0f} m です。メートル単位で指定してください。</translation>
    </message>
    <message>
        <source>{name}: “{key}” of {entry} is no number.</source>
        <translation>{name}: {entry}の「{key}」が数値ではありません。</translation>
    </message>
    <message>
        <source>{name} has no column {missing}: control points need {columns} (heights may be left out).</source>
        <translation>{name}に列{missing}がありません。基準点（検証点）には{columns}が必要です（高さは省略可）。</translation>
    </message>
    <message>
        <source>{name} holds no control point.</source>
        <translation>{name}に基準点（検証点）がありません。</translation>
    </message>
    <message>
        <source>{name}: row {wrong} has no number in the column {column}.</source>
        <translation>{name}: {wrong} 行目の列{column}が数値ではありません。</translation>
    </message>
    <message>
        <source>Control point {id} lies {away:.0f} m from its place in the survey: check that both are in the same coordinate reference system.</source>
        <translation>検証点{id}は計測データ上の位置から {away:.0f} m 離れています。両方が同じ座標参照系か確認してください。</translation>
    </message>
    <message>
        <source>No control point lies in the survey's time: there is nothing to measure.</source>
        <translation>計測の時間内に検証点がないため、精度を確認できません。</translation>
    </message>
    <message>
        <source>They fit if the former count {count}: convert their times to GPS seconds.</source>
        <translation>前者の時刻を「{count}」とみなすと合います。GPS 秒に変換してください。</translation>
    </message>
    <message>
        <source>Unix time (seconds since 1970)</source>
        <translation>Unix 時刻（1970年からの秒）</translation>
    </message>
    <message>
        <source>milliseconds</source>
        <translation>ミリ秒</translation>
    </message>
    <message>
        <source>microseconds</source>
        <translation>マイクロ秒</translation>
    </message>
    <message>
        <source>nanoseconds</source>
        <translation>ナノ秒</translation>
    </message>
    <message>
        <source>milliseconds of Unix time</source>
        <translation>Unix 時刻のミリ秒</translation>
    </message>
    <message>
        <source>microseconds of Unix time</source>
        <translation>Unix 時刻のマイクロ秒</translation>
    </message>
    <message>
        <source>nanoseconds of Unix time</source>
        <translation>Unix 時刻のナノ秒</translation>
    </message>
    <message>
        <source>seconds of the day</source>
        <translation>その日の0時からの秒</translation>
    </message>
    <message>
        <source>seconds of the hour</source>
        <translation>正時からの秒</translation>
    </message>
    <message>
        <source>They fit if the trajectory counts {count}: convert its times to GPS seconds.</source>
        <translation>軌跡の時刻を「{count}」とみなすと合います。GPS 秒に変換してください。</translation>
    </message>
    <message>
        <source>The points of {paths} carry no GPS time, which ties them to the trajectory: export the survey with it.</source>
        <translation>{paths}の点に、軌跡と対応付けるためのGPS時刻がありません。GPS時刻付きで計測データを出力してください。</translation>
    </message>
    <message>
        <source>No GPS time in {paths} is a number: export the survey with the points' times.</source>
        <translation>{paths} の GPS 時刻がすべて数ではありません。点の時刻を付けて計測データを出力し直してください。</translation>
    </message>
    <message>
        <source>All GPS times in {paths} are zero: export the survey with the points' times.</source>
        <translation>{paths}のGPS時刻がすべて0です。点の時刻付きで計測データを出力してください。</translation>
    </message>
    <message>
        <source>{zeros} of {count} points in {paths} have the GPS time 0, and the others {lowest:.1f} to {last:.1f} s: remove those without a time, or export the survey again.</source>
        <translation>{paths} の {count} 点中 {zeros} 点の GPS 時刻が 0 で、その他は {lowest:.1f}～{last:.1f} 秒です。時刻のない点を取り除くか、計測データを書き出し直してください。</translation>
    </message>
    <message>
        <source>{what} were measured from {span:.1f} to {span_2:.1f} s{kind}, but the trajectory runs from {wanted:.1f} to {wanted_2:.1f} s: give those of one survey.</source>
        <translation>{what}の計測時刻は {span:.1f}～{span_2:.1f} s{kind} ですが、軌跡は {wanted:.1f}～{wanted_2:.1f} s です。同じ計測のものを指定してください。</translation>
    </message>
    <message>
        <source>The survey is too large for one cloth: choose a coarser cloth resolution, or filter parts of it.</source>
        <translation>計測データが大きすぎて1枚の布では処理できません。布の解像度を粗くするか、部分ごとにフィルタ処理してください。</translation>
    </message>
    <message>
        <source>In {count} of {all} seconds of the drive, from {first:.0f} s on, less than half as many of the points are ground as elsewhere ({poor:.0f} % for {usual:.0f} %): at steep or humped stretches the cloth leaves ground out; look at them, or give a finer cloth.</source>
        <translation>走行の {all} 秒のうち {count} 秒({first:.0f} 秒以降)で、地面とされた点の割合がほかの区間の半分未満です({usual:.0f} % に対して {poor:.0f} %)。急な坂やこぶのある区間では布フィルターが地面を取り残します。そこを確認するか、より細かい布を指定してください。</translation>
    </message>
    <message>
        <source>Only {ground:,} of {candidates:,} points were found to be ground ({ground_2:.2g} %, needed {min_share:g} %), which cannot be right for a drive: look for many points below the road, a wrong height unit or a survey that does not show the ground; a smaller minimum ground share accepts it.</source>
        <translation>地表面と判定された点が {candidates:,} 点のうち {ground:,} 点（{ground_2:.2g} %、必要な割合 {min_share:g} %）しかなく、走行の計測として正しくありません。路面より下の多数の点、高さの単位の誤り、地表面が写っていない計測でないかを確認してください。地表面点の最小割合を小さくすれば受け入れられます。</translation>
    </message>
    <message>
        <source>{path}: row {ragged} has {rows_count} values, the header names {header_count}: the file may be cut off; export it again.</source>
        <translation>{path}: {ragged} 行目の値は {rows_count} 個ですが、ヘッダの項目は {header_count} 個です。ファイルが途中で切れている可能性があります。再度出力してください。</translation>
    </message>
    <message>
        <source>{name} has no column {missing} or no row: image poses need {columns}.</source>
        <translation>{name}に列{missing}がないか、行がありません。画像の位置姿勢には{columns}が必要です。</translation>
    </message>
    <message>
        <source>{name} has no number in row {bad}: correct or remove it.</source>
        <translation>{name}の {bad} 行目に数値がありません。修正するか、削除してください。</translation>
    </message>
    <message>
        <source>{name}: all angles are below {turn:.1f} although the images look in many directions: they are radians; say that the angles are counted so, or export degrees.</source>
        <translation>{name}：画像の向きはさまざまなのに、すべての角が {turn:.1f} 未満です。ラジアンと見られます。角の単位を指定するか、度で出力してください。</translation>
    </message>
    <message>
        <source>No control point lies in the survey's time: the trajectory cannot be updated.</source>
        <translation>計測の時間内に基準点がないため、軌跡を更新できません。</translation>
    </message>
    <message>
        <source>The ground does not reach the trajectory's course: give a ground of the same place and coordinate reference system.</source>
        <translation>地表面が走行軌跡に届いていません。同じ場所・同じ座標参照系の地表面を指定してください。</translation>
    </message>
    <message>
        <source>The trajectory lies {above:.1f} m above the ground (median), not {start:.1f} m: check the origin's height and both height systems.</source>
        <translation>軌跡の地表面からの高さが {start:.1f} m ではなく {above:.1f} m（中央値）です。原点の高さと両方の高さの基準を確認してください。</translation>
    </message>
    <message>
        <source>The range scans do not say which scanner measured them, and the calibration has {scanners_count}: add a column scanner.</source>
        <translation>測距スキャンに計測したスキャナの記載がなく、校正値にはスキャナが {scanners_count} 台あります。列 scanner を追加してください。</translation>
    </message>
    <message>
        <source>All angles are within {max:.2f} degrees: if they are radians, say so.</source>
        <translation>角度がすべて {max:.2f} 度以内です。ラジアンの場合は、そのように指定してください。</translation>
    </message>
    <message>
        <source>The files hold no returns: choose other range scans.</source>
        <translation>ファイルに反射点がありません。別の測距スキャンを選択してください。</translation>
    </message>
    <message>
        <source>The range scans were measured from {span:.1f} to {span_2:.1f} s, but the trajectory runs from {time:.1f} to {time_2:.1f} s: give those of one survey.</source>
        <translation>測距スキャンの計測時刻は {span:.1f}～{span_2:.1f} s ですが、軌跡は {time:.1f}～{time_2:.1f} s です。同じ計測のものを指定してください。</translation>
    </message>
    <message>
        <source>No return could be placed: all are without a range or outside the limits of range and time.</source>
        <translation>座標を付けられる反射点がありません。すべて距離がないか、距離・時刻の制限の範囲外です。</translation>
    </message>
    <message>
        <source>The strip image was taken from {times:.1f} to {times_2:.1f} s, the trajectory runs from {time:.1f} to {time_2:.1f} s: give those of one survey.</source>
        <translation>ストリップ画像の撮影時刻は {times:.1f}～{times_2:.1f} s ですが、軌跡は {time:.1f}～{time_2:.1f} s です。同じ計測のものを指定してください。</translation>
    </message>
    <message>
        <source>{path} is of no known kind: range scans come as {suffixes}.</source>
        <translation>{path}は未対応の形式です。測距スキャンの形式は{suffixes}です。</translation>
    </message>
    <message>
        <source>No range scans were given: choose one or several files.</source>
        <translation>測距スキャンが与えられていません。ファイルを1つ以上選択してください。</translation>
    </message>
    <message>
        <source>The range scans {path} do not exist: check the file's name.</source>
        <translation>測距スキャン{path}が存在しません。ファイル名を確認してください。</translation>
    </message>
    <message>
        <source>{file} has no column {missing}: range scans need time, angle and range, and may have intensity and scanner.</source>
        <translation>{file}に列{missing}がありません。測距スキャンには時刻、角度、距離が必要で、反射強度とスキャナは任意です。</translation>
    </message>
    <message>
        <source>{file} holds something that is no number{where} ({split}): correct it or export the scans again.</source>
        <translation>{file}に数値でない値があります{where}（{split}）。修正するか、スキャンを再度出力してください。</translation>
    </message>
    <message>
        <source>{path} cannot be read as Parquet ({error}): check the file.</source>
        <translation>{path}をParquetとして読み込めません（{error}）。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{path} has a return without a time or an angle that is a number (return {bad} of those read at a time): correct it or export the scans again.</source>
        <translation>{path}に、時刻または角度が数値でない反射点があります（一度に読み込む中の {bad} 番目）。修正するか、スキャンを再度出力してください。</translation>
    </message>
    <message>
        <source>{path} is a Parquet file, and the package pyarrow that reads these cannot be loaded ({error}): install it (pip install pyarrow) or export the scans as CSV.</source>
        <translation>{path}はParquetファイルですが、読み込みに必要なパッケージ pyarrow を読み込めません（{error}）。インストールする（pip install pyarrow）か、スキャンをCSVで出力してください。</translation>
    </message>
    <message>
        <source>{path} cannot be read ({error}): it may be cut off; copy it again.</source>
        <translation>{path}を読み込めません（{error}）。途中で切れている可能性があります。再度コピーしてください。</translation>
    </message>
    <message>
        <source>The paper's method needs the height of the trajectory's origin above the ground: give it, or leave out the ground.</source>
        <translation>論文の方法には、軌跡の原点の地表面からの高さが必要です。指定するか、地表面を省略してください。</translation>
    </message>
    <message>
        <source>{unique_count} sets do not tell how good the tie points are: give their sigma, or add sets.</source>
        <translation>{unique_count} 組からはタイポイントの精度が分かりません。σを指定するか、組を追加してください。</translation>
    </message>
    <message>
        <source>its pairs do not fit each other by {fit:.2f} m</source>
        <translation>対応点どうしが {fit:.2f} m 合いません</translation>
    </message>
    <message>
        <source>it would rotate the vehicle by {rotation:.0f} degrees; its points may be swapped</source>
        <translation>車両が {rotation:.0f} 度回転してしまいます。点が入れ替わっている可能性があります</translation>
    </message>
    <message>
        <source>All {names_count} sets of tie points contradict themselves: check which place belongs to which, and the coordinate reference system.</source>
        <translation>タイポイントの {names_count} 組すべてが組の内部で矛盾しています。対応する地点の組合せと座標参照系を確認してください。</translation>
    </message>
    <message>
        <source>No set has two pairs: the paper's method needs sets of two; add pairs, or take another method.</source>
        <translation>対応点が2つある組がありません。論文の方法には2対応点の組が必要です。対応点を追加するか、別の方法を選択してください。</translation>
    </message>
    <message>
        <source>Sets {names} and {names_2} contradict each other: within {step:.1f} s the drift would change by {change:.1f} m; check both.</source>
        <translation>組{names}と{names_2}が矛盾しています。{step:.1f} s の間にドリフトが {change:.1f} m 変化することになります。両方を確認してください。</translation>
    </message>
    <message>
        <source>The tie points lie within {last:.0f} of {duration:.0f} s: the rest of the course is only moved along with them, and its sigma grows; add sets there.</source>
        <translation>タイポイントは {duration:.0f} s のうち {last:.0f} s の範囲にしかありません。残りの走行軌跡はそれに伴って移動するだけでσが大きくなります。その部分に組を追加してください。</translation>
    </message>
    <message>
        <source>{left_out} of {samples} samples of the ground along the course stand out and are left out: check that it is the ground that was driven on.</source>
        <translation>走行軌跡に沿う地表面のサンプル {samples} 個のうち {left_out} 個が外れ値のため除外されました。走行した地表面か確認してください。</translation>
    </message>
    <message>
        <source>Set {name}: {own_count} of {own_count_2} pairs contradict the others and are left out.</source>
        <translation>組{name}: 対応点 {own_count_2} 個のうち {own_count} 個が他と矛盾するため除外しました。</translation>
    </message>
    <message>
        <source>Set {name} contradicts itself and is left out: {reason}.</source>
        <translation>組{name}は内部で矛盾しているため除外しました: {reason}。</translation>
    </message>
    <message>
        <source>Set {name} has one pair and is left out: the paper's method needs two.</source>
        <translation>組{name}は対応点が1つのため除外しました。論文の方法には2つ必要です。</translation>
    </message>
    <message>
        <source>Set {name} has {own_count} pairs: the paper's method takes the first two.</source>
        <translation>組{name}には対応点が {own_count} 個あります。論文の方法では最初の2つを使用します。</translation>
    </message>
    <message>
        <source>Set {name} contradicts itself by {fit:.2f} m; the paper's method uses it all the same.</source>
        <translation>組{name}の内部の矛盾は {fit:.2f} m ですが、論文の方法ではそのまま使用します。</translation>
    </message>
    <message>
        <source>Set {name} lies {away:.2f} m from where the other sets put it and is left out: check that survey and reference show the same place.</source>
        <translation>組{name}は他の組から求めた位置から {away:.2f} m 離れているため除外しました。計測データと基準データが同じ場所を示しているか確認してください。</translation>
    </message>
    <message>
        <source>Set {name} lies {away:.2f} m from where the other sets put it: check that survey and reference show the same place.</source>
        <translation>組{name}は他の組から求めた位置から {away:.2f} m 離れています。計測データと基準データが同じ場所を示しているか確認してください。</translation>
    </message>
    <message>
        <source>{used_count} of {sets_count} sets of tie points are used; after the rectification they lie {figures:.2f} m from the reference on average.</source>
        <translation>タイポイントの組 {sets_count} 組中 {used_count} 組を使いました。補正後の基準からの距離は平均 {figures:.2f} m です。</translation>
    </message>
    <message>
        <source>beyond the sets</source>
        <translation>組の範囲外</translation>
    </message>
    <message>
        <source> {left_out} were left out: look at them in the table below.</source>
        <translation> {left_out} 組を除きました。下の表で確認してください。</translation>
    </message>
    <message>
        <source>Sets of tie points used</source>
        <translation>使用したタイポイントの組</translation>
    </message>
    <message>
        <source>Distance of the tie points from the reference before, m</source>
        <translation>タイポイントの基準からの距離、補正前 (m)</translation>
    </message>
    <message>
        <source>after, m</source>
        <translation>補正後、m</translation>
    </message>
    <message>
        <source>Off without itself, mean over the sets, m</source>
        <translation>その組を除いた場合のずれ、組の平均 (m)</translation>
    </message>
    <message>
        <source>Moved in plan, mean, m</source>
        <translation>水平移動量、平均 (m)</translation>
    </message>
    <message>
        <source>maximum, m</source>
        <translation>最大、m</translation>
    </message>
    <message>
        <source>Sigma of a coordinate between the sets, mean, m</source>
        <translation>組の間の座標の標準偏差、平均 (m)</translation>
    </message>
    <message>
        <source>maximum of all epochs, m</source>
        <translation>全エポックの最大 (m)</translation>
    </message>
    <message>
        <source>Share of the epochs before the first or after the last set</source>
        <translation>最初の組より前、または最後の組より後のエポックの割合</translation>
    </message>
    <message>
        <source>Errors of heading rotate the course (dead reckoning)</source>
        <translation>ヘディングの誤差で経路が回転する（推測航法）</translation>
    </message>
    <message>
        <source>Drift follows the accuracy that the navigation states</source>
        <translation>ドリフトは航法解析の示す精度に従う</translation>
    </message>
    <message>
        <source>Random walk of the position, m per root second</source>
        <translation>位置のランダムウォーク (m/√s)</translation>
    </message>
    <message>
        <source>of the heading, ° per root second</source>
        <translation>ヘディングのランダムウォーク (°/√s)</translation>
    </message>
    <message>
        <source>Sigma of a tie point's coordinate, m</source>
        <translation>タイポイントの座標の標準偏差 (m)</translation>
    </message>
    <message>
        <source>Sigmas are multiplied by</source>
        <translation>標準偏差に掛けた係数</translation>
    </message>
    <message>
        <source>{used} of {given}</source>
        <translation>{given} 組中 {used} 組</translation>
    </message>
    <message>
        <source>Correction to the east with its sigma. A set that lies beside the curve's band does not fit the others.</source>
        <translation>東方向の補正量とその標準偏差です。曲線の帯から外れる組は、ほかの組と合っていません。</translation>
    </message>
    <message>
        <source>Correction to the north with its sigma. A set that lies beside the curve's band does not fit the others.</source>
        <translation>北方向の補正量とその標準偏差です。曲線の帯から外れる組は、ほかの組と合っていません。</translation>
    </message>
    <message>
        <source>Halfway between sets expect less than {predicted:.2f} m.</source>
        <translation>組の中間では {predicted:.2f} m 未満と見込まれます。</translation>
    </message>
    <message>
        <source>Read the remarks below first.</source>
        <translation>まず下の注記を読んでください。</translation>
    </message>
    <message>
        <source>East correction</source>
        <translation>東方向の補正量</translation>
    </message>
    <message>
        <source>North correction</source>
        <translation>北方向の補正量</translation>
    </message>
    <message>
        <source>The height of the origin above the ground was not given: the mean height stays as reported ({sensor_height:.2f} m above the ground).</source>
        <translation>原点の地表面からの高さが与えられていないため、平均の高さは補正前のままとします（地表面から {sensor_height:.2f} m）。</translation>
    </message>
    <message>
        <source>{pairs} of {given}</source>
        <translation>{given} 個中 {pairs} 個</translation>
    </message>
    <message>
        <source>Ground truths must be at different epochs, in the order of time.</source>
        <translation>真値は時刻順の異なるエポックにしてください。</translation>
    </message>
    <message>
        <source>The calibration of camera {id} cannot be right: rows and focal_length_px must be greater than 0, margin_px less than half the rows.</source>
        <translation>カメラ{id}の校正値が正しくありません。rows と focal_length_px は0より大きく、margin_px は行数の半分未満にしてください。</translation>
    </message>
    <message>
        <source>No strip image was given: choose one or several images of line cameras.</source>
        <translation>ストリップ画像が与えられていません。ラインカメラの画像を1つ以上選択してください。</translation>
    </message>
    <message>
        <source>The calibration does not say which camera took {path} (it has: {known}): give the camera's entry an “image” with this file name.</source>
        <translation>校正値から{path}を撮影したカメラが分かりません（記載: {known}）。カメラの項目に、このファイル名の「image」を追加してください。</translation>
    </message>
    <message>
        <source>{path} has {rows} rows, its camera {id} has {rows_2}: choose the image of this camera.</source>
        <translation>{path}は {rows} 行ですが、カメラ{id}は {rows_2} 行です。このカメラの画像を選択してください。</translation>
    </message>
    <message>
        <source>The strip image {path} does not exist: check its name.</source>
        <translation>ストリップ画像{path}が存在しません。名前を確認してください。</translation>
    </message>
    <message>
        <source>{path} must have the columns column and time.</source>
        <translation>{path}には列 column と time が必要です。</translation>
    </message>
    <message>
        <source>{path} gives times for {unique_count} columns, {image} has {columns}: each column needs one, numbered from 0.</source>
        <translation>{path}の時刻は {unique_count} 列分ですが、{image}は {columns} 列です。0から番号を付けた各列に1つずつ必要です。</translation>
    </message>
    <message>
        <source>{image} has {columns} column: a strip needs at least two.</source>
        <translation>{image}は {columns} 列しかありません。ストリップ画像には2列以上必要です。</translation>
    </message>
    <message>
        <source>{path}: the time of column {at} is not later than that of the column before; correct it.</source>
        <translation>{path}: 列 {at} の時刻が前の列の時刻より後になっていません。修正してください。</translation>
    </message>
    <message>
        <source>The strip image has no file.</source>
        <translation>ストリップ画像にファイルがありません。</translation>
    </message>
    <message>
        <source>{path} must be an image of 8 or 16 bits.</source>
        <translation>{path}は8または16ビットの画像にしてください。</translation>
    </message>
    <message>
        <source>The calibration of camera {id} has no number “{key}”: a line camera needs rows, focal_length_px and centre_px.</source>
        <translation>カメラ{id}の校正値に数値「{key}」がありません。ラインカメラには rows、focal_length_px、centre_px が必要です。</translation>
    </message>
    <message>
        <source>There are no times for {image}: put a table column,time named {path} beside it.</source>
        <translation>{image}の時刻がありません。column,time の表{path}を同じ場所に置いてください。</translation>
    </message>
    <message>
        <source>{path} cannot be read as a table of times: {error}.</source>
        <translation>{path}を時刻の表として読み込めません: {error}。</translation>
    </message>
    <message>
        <source>No corner of a building lies within {max_distance:.0f} m of the course: give outlines or a surface of the same place and coordinate reference system.</source>
        <translation>走行軌跡から {max_distance:.0f} m 以内に建物の角がありません。同じ場所・同じ座標参照系の外周線または表層を指定してください。</translation>
    </message>
    <message>
        <source>Of {place_count} corners near the course no two were found in the survey close enough to each other: assign tie points by hand.</source>
        <translation>走行軌跡付近の角 {place_count} 個のうち、互いに十分近い2つを計測データで見つけられませんでした。タイポイントを手動で指定してください。</translation>
    </message>
    <message>
        <source>No point of the survey lies at the height of walls near the course within the trajectory's time.</source>
        <translation>軌跡の時間内で、走行軌跡付近の壁面の高さに計測点がありません。</translation>
    </message>
    <message>
        <source>The survey shows no walls: its points nowhere stand over each other.</source>
        <translation>計測データに壁面がありません。点が上下に重なる箇所がありません。</translation>
    </message>
    <message>
        <source>{path}: not every row has as many values as the header; the file may be cut off.</source>
        <translation>{path}: 値の数がヘッダと異なる行があります。ファイルが途中で切れている可能性があります。</translation>
    </message>
    <message>
        <source>{name} has no column {missing}: tie points need {columns}.</source>
        <translation>{name}に列{missing}がありません。タイポイントには{columns}が必要です。</translation>
    </message>
    <message>
        <source>{name} holds no tie points: give at least one set of two pairs.</source>
        <translation>{name}にタイポイントがありません。対応点が2つある組を1組以上指定してください。</translation>
    </message>
    <message>
        <source>{name}: in set {sets} survey and reference are {apart:,.0f} m apart; both must be in the survey's coordinate reference system.</source>
        <translation>{name}: 組{sets}で計測データと基準データが {apart:,.0f} m 離れています。両方とも計測データの座標参照系にしてください。</translation>
    </message>
    <message>
        <source>{shift:.0f} s were added to the times of the tie points, which are counted otherwise than those of the trajectory: make sure that both are of one survey.</source>
        <translation>タイポイントの時刻は軌跡と数え方が異なるため、{shift:.0f} s を加えました。両方が同じ計測のものか確認してください。</translation>
    </message>
    <message>
        <source>{inside_count} tie points lie outside the trajectory's time and are left out (set {some}).</source>
        <translation>タイポイント {inside_count} 点は軌跡の時間外にあるため除外しました（組{some}）。</translation>
    </message>
    <message>
        <source>All tie points lie in gaps of the trajectory: choose others.</source>
        <translation>すべてのタイポイントが軌跡の欠測区間にあります。別のものを選択してください。</translation>
    </message>
    <message>
        <source>The tie points of set {some} lie in a gap of the trajectory and are left out.</source>
        <translation>組{some}のタイポイントは軌跡の欠測区間にあるため除外しました。</translation>
    </message>
    <message>
        <source>The intensity of asphalt over range cannot be told in {paths} ({reason}): give a longer stretch of road.</source>
        <translation>{paths}では、距離に対するアスファルトの反射強度を決定できません（{reason}）。より長い道路区間を指定してください。</translation>
    </message>
    <message>
        <source>The lasers of scanner {number} are told apart by {told_by}: asphalt scatters by {after:.0f} % instead of {before:.0f} %.</source>
        <translation>スキャナ {number} のレーザを{told_by}で区別しました。アスファルトのばらつきは {before:.0f} % から {after:.0f} % になりました。</translation>
    </message>
    <message>
        <source>{points_count:,} marking points on {marked_share:.0f} % of the path. </source>
        <translation>路面標示点 {points_count:,} 点、走行経路の {marked_share:.0f} %。 </translation>
    </message>
    <message>
        <source>Scanner {number}</source>
        <translation>スキャナ {number}</translation>
    </message>
    <message>
        <source>Scanner {number} has no curve and its points are left out: {reason}.</source>
        <translation>スキャナ {number} は曲線が得られないため、その点を除外しました: {reason}。</translation>
    </message>
    <message>
        <source>No marking points were found: the road has no paint, or its intensity does not show it.</source>
        <translation>路面標示点が見つかりません。路面に標示がないか、反射強度に表れていません。</translation>
    </message>
    <message>
        <source>I_ref (reference)</source>
        <translation>I_ref（基準値）</translation>
    </message>
    <message>
        <source>Their intensities follow the curves of the scanners. Look at them over an aerial image before they are matched.</source>
        <translation>強度はスキャナごとの曲線に従っています。照合する前に空中写真上で確認してください。</translation>
    </message>
    <message>
        <source>The marking points are only {contrast_of:.1f} times as bright as the ground beside them: look at them before they are used.</source>
        <translation>路面標示点の明るさが周囲の地表面の {contrast_of:.1f} 倍しかありません。使用する前に確認してください。</translation>
    </message>
    <message>
        <source>The asphalt of scanner {number} does not follow one curve over range (residual {residual:.0f} %): several surfaces may have been taken together.</source>
        <translation>スキャナ {number} のアスファルトは、距離に対する1つの曲線に従いません（残差 {residual:.0f} %）。複数の路面をまとめて扱った可能性があります。</translation>
    </message>
    <message>
        <source>Single asphalt points of scanner {number} scatter by {scatter:.0f} %: only strong paint stands out, and bright specks may be taken for paint.</source>
        <translation>スキャナ {number} のアスファルトの個々の点は {scatter:.0f} % ばらついています。濃い標示しか識別できず、明るい斑点を標示と誤る可能性があります。</translation>
    </message>
    <message>
        <source>Range, m</source>
        <translation>斜距離 (m)</translation>
    </message>
    <message>
        <source>Intensity</source>
        <translation>反射強度</translation>
    </message>
    <message>
        <source>too few ground points with intensity at different ranges</source>
        <translation>反射強度を持つ地表面点が、異なる距離で十分にありません</translation>
    </message>
    <message>
        <source>the intensity of asphalt scatters too much to tell paint from it</source>
        <translation>アスファルトの反射強度のばらつきが大きく、標示と区別できません</translation>
    </message>
    <message>
        <source>no surface of even intensity can be followed over the ranges</source>
        <translation>距離に沿って追跡できる、反射強度の一様な面がありません</translation>
    </message>
    <message>
        <source>{outside:,} of {points:,} points were measured where the trajectory has no epochs and are left out.</source>
        <translation>{points:,} 点のうち {outside:,} 点は、軌跡にエポックがない箇所で計測されたため除外しました。</translation>
    </message>
    <message>
        <source>{standing:,} points measured while the vehicle stood are left out.</source>
        <translation>停車中に計測された {standing:,} 点を除外しました。</translation>
    </message>
    <message>
        <source>Finding the markings.</source>
        <translation>路面標示を検出しています。</translation>
    </message>
    <message>
        <source>Finding the ground.</source>
        <translation>地表面を抽出しています。</translation>
    </message>
    <message>
        <source>Taking the points of ground classes.</source>
        <translation>地表面クラスの点を取得しています。</translation>
    </message>
    <message>
        <source>The block of the paper's threshold must be {pixel:g} m or larger, and c above 0.</source>
        <translation>論文のしきい値処理のブロックは {pixel:g} m 以上、c は0より大きくしてください。</translation>
    </message>
    <message>
        <source>The marking points' columns differ in length.</source>
        <translation>路面標示点の各列の長さが異なります。</translation>
    </message>
    <message>
        <source>{name} has no ground points near the vehicle: give the survey with its road.</source>
        <translation>{name}には車両の近くに地表面点がありません。道路を含む計測データを指定してください。</translation>
    </message>
    <message>
        <source>Only {ground:,} of {near:,} points near the vehicle of {name} were found to be ground ({share:.2g} %), which cannot be right for a drive: look for many points below the road or a wrong height unit, or classify the ground first.</source>
        <translation>{name}の車両付近の点{near:,}点のうち、地面とされた点は{ground:,}点（{share:.2g} %）だけで、走行計測としてあり得ません。道路より下にある多数の点や高さの単位の誤りがないか確認するか、先に地面を分類してください。</translation>
    </message>
    <message>
        <source>{name} has no intensity (all are 0), by which markings are told: export the survey with it.</source>
        <translation>{name}に、路面標示の識別に必要な反射強度がありません（すべて0）。反射強度付きで計測データを出力してください。</translation>
    </message>
    <message>
        <source>All points of {name} have the intensity {values}, by which markings cannot be told: export the survey with the measured intensities.</source>
        <translation>{name} の点の反射強度はすべて {values} で、標示を見分けられません。計測された反射強度を付けて計測データを書き出してください。</translation>
    </message>
    <message>
        <source> (they lie {heights:+.0f} m above the scanner)</source>
        <translation>（スキャナより {heights:+.0f} m の位置にあります）</translation>
    </message>
    <message>
        <source>No point of {name} lies within {max_range:g} m of the trajectory{apart}: give both in the same coordinate and height system.</source>
        <translation>{name}に、軌跡から {max_range:g} m 以内の点がありません{apart}。両方を同じ座標系・高さの基準で指定してください。</translation>
    </message>
    <message>
        <source>The corrected trajectory runs from {time:.1f} to {time_2:.1f} s, the reported one from {time_3:.1f} to {time_4:.1f} s: give two of one survey.</source>
        <translation>補正後の軌跡は {time:.1f}～{time_2:.1f} s ですが、補正前の軌跡は {time_3:.1f}～{time_4:.1f} s です。同じ計測の2つを指定してください。</translation>
    </message>
    <message>
        <source>part of the markings lies elsewhere</source>
        <translation>標示の一部が別の位置</translation>
    </message>
    <message>
        <source>a good part of the markings lies elsewhere by one shift</source>
        <translation>標示のかなりの部分が同じずれだけ別の位置にあります</translation>
    </message>
    <message>
        <source>no markings just before or after the patch</source>
        <translation>パッチの直前または直後に路面標示がありません</translation>
    </message>
    <message>
        <source>few of the markings here are in the reference</source>
        <translation>ここの路面標示は基準にほとんどありません</translation>
    </message>
    <message>
        <source>the trajectory has a gap here</source>
        <translation>ここに軌跡の欠測があります</translation>
    </message>
    <message>
        <source>the trajectory jumps here</source>
        <translation>ここで軌跡が跳んでいます</translation>
    </message>
    <message>
        <source>the correction reaches the largest error looked for</source>
        <translation>補正量が探索する最大誤差に達しています</translation>
    </message>
    <message>
        <source>the markings do not fix the position well</source>
        <translation>路面標示から位置がよく決まりません</translation>
    </message>
    <message>
        <source>the markings around do not fix the position in all directions</source>
        <translation>周囲の路面標示からは全方向の位置が決まりません</translation>
    </message>
    <message>
        <source>no markings registered around the patch</source>
        <translation>パッチの周囲に位置合わせできた路面標示がありません</translation>
    </message>
    <message>
        <source>the markings here contradict those around</source>
        <translation>ここの路面標示は周囲と矛盾します</translation>
    </message>
    <message>
        <source>another position of the markings fits as well</source>
        <translation>路面標示の別の位置も同程度に合います</translation>
    </message>
    <message>
        <source>the markings of the window do not fix the position well</source>
        <translation>ウィンドウの路面標示では位置が十分に決まりません</translation>
    </message>
    <message>
        <source>another position of the markings fits as well or better</source>
        <translation>路面標示の別の位置も同程度以上に合います</translation>
    </message>
    <message>
        <source>no markings in the window: moved as the patch before</source>
        <translation>ウィンドウに路面標示がありません。前のパッチと同じだけ移動しました</translation>
    </message>
    <message>
        <source>the matching of the window did not converge</source>
        <translation>ウィンドウの位置合わせが収束しませんでした</translation>
    </message>
    <message>
        <source>No window of the survey could be registered to the reference markings: check that both show the same streets in the same coordinate system, and that the survey has intensities that show paint.</source>
        <translation>計測データのどのウィンドウも、基準の路面標示に位置合わせできませんでした。両方が同じ道路を同じ座標系で示しているか、計測データの反射強度に標示が表れているか確認してください。</translation>
    </message>
    <message>
        <source>the windows around it contradict each other</source>
        <translation>周囲のウィンドウの結果が互いに矛盾します</translation>
    </message>
    <message>
        <source>the drive is too short to tell how accurate it is</source>
        <translation>走行区間が短く、精度が分かりません</translation>
    </message>
    <message>
        <source>step of the drive or of the reference</source>
        <translation>走行側または基準側の段差</translation>
    </message>
    <message>
        <source>changed markings</source>
        <translation>変化した標示</translation>
    </message>
    <message>
        <source>reference and survey disagree</source>
        <translation>基準と計測の不一致</translation>
    </message>
    <message>
        <source>hidden step</source>
        <translation>隠れた段差</translation>
    </message>
    <message>
        <source>reference and survey disagree: one side of a step may be wrong</source>
        <translation>基準と計測の不一致：段差のどちらか一方の側が誤りかもしれません</translation>
    </message>
    <message>
        <source>the markings here changed: reference and survey disagree</source>
        <translation>この区間の標示は変化している：基準と計測の不一致</translation>
    </message>
    <message>
        <source>a step of the error hides here, where no markings are</source>
        <translation>標示のないこの区間に誤差の段差が隠れている</translation>
    </message>
    <message>
        <source>reference and survey disagree: a stretch of the markings changed, or all others did</source>
        <translation>基準と測量成果が一致しません：区画線の一部の区間が変わったか、他のすべてが変わっています</translation>
    </message>
    <message>
        <source>markings and walls disagree</source>
        <translation>標示と壁面の不一致</translation>
    </message>
    <message>
        <source>markings and walls disagree here</source>
        <translation>ここでは標示と壁面が一致しません</translation>
    </message>
    <message>
        <source>No section of the survey could be registered to the reference markings: check that both show the same streets in the same coordinate system, and that the survey has intensities that show paint.</source>
        <translation>計測データのどの区間も、基準の路面標示に位置合わせできませんでした。両方が同じ道路を同じ座標系で示しているか、計測データの反射強度に標示が表れているか確認してください。</translation>
    </message>
    <message>
        <source>The expected share of outliers must lie between 0 and 1.</source>
        <translation>外れ値の想定割合は0と1の間にしてください。</translation>
    </message>
    <message>
        <source>Points score in the cells {cells}, not {cells_2}.</source>
        <translation>点を評価するセルは{cells}のいずれかです。{cells_2}は指定できません。</translation>
    </message>
    <message>
        <source>The longest window must not be shorter than the smallest one.</source>
        <translation>最長のウィンドウは最小のウィンドウより短くできません。</translation>
    </message>
    <message>
        <source>A registration in 3D needs the ground's heights: give a ground raster or marking polygons with z.</source>
        <translation>3Dの位置合わせには地表面の高さが必要です。地表面のラスタ、またはz値付きの路面標示ポリゴンを指定してください。</translation>
    </message>
    <message>
        <source>No marking point was measured within the trajectory's time: check that both are of one survey.</source>
        <translation>軌跡の時間内に計測された路面標示点がありません。両方が同じ計測のものか確認してください。</translation>
    </message>
    <message>
        <source>standard deviation in plan over the whole path {sigma:.1f} cm (median)</source>
        <translation>全経路の水平位置の標準偏差 {sigma:.1f} cm（中央値）</translation>
    </message>
    <message>
        <source>how accurate it is is not known</source>
        <translation>精度は不明です</translation>
    </message>
    <message>
        <source>{share:.0f} % of the path is registered, {share_2:.0f} % bridged; {spread}.</source>
        <translation>走行経路の {share:.0f} % が位置合わせ済み、{share_2:.0f} % が補間です。{spread}。</translation>
    </message>
    <message>
        <source>Steps of the reference are told from {median:.2f} m on (median along the path, {largest:.2f} m at most); standard deviations hold smaller ones and the {sigma:.1f} cm stated for the reference.</source>
        <translation>基準の段差は {median:.2f} m 以上で検出されます（経路に沿った中央値、最大 {largest:.2f} m）。標準偏差には、それより小さい段差と、基準の精度として指定された {sigma:.1f} cm が含まれます。</translation>
    </message>
    <message>
        <source>The reported heading contradicts the markings by {correction:.1f} degrees (median), much more than its accuracy: it was corrected; check the calibration and the trajectory.</source>
        <translation>補正前の方位が路面標示と {correction:.1f} 度（中央値）食い違い、その精度を大きく超えていたため補正しました。校正値と軌跡を確認してください。</translation>
    </message>
    <message>
        <source>Reference and survey disagree at {count} places, the first at {place:.0f} m by {size:.2f} m ({kind}): see the steps' layer and the report.</source>
        <translation>基準と計測が{count}か所で一致しません。最初の箇所は{place:.0f} m地点、{size:.2f} m（{kind}）です。不一致のレイヤと報告書を確認してください。</translation>
    </message>
    <message>
        <source>{share:.0f} % of the path is not to be trusted, the longest section from {longest_start:.0f} to {end:.0f} m ({reason}): see the patches' layer.</source>
        <translation>走行経路の {share:.0f} % は信頼できません。最長の区間は {longest_start:.0f}～{end:.0f} m です（{reason}）。パッチのレイヤを参照してください。</translation>
    </message>
    <message>
        <source>{registered:.0f} % of the path is registered. The standard deviation in plan over the whole path is {sigma:.1f} cm (median).</source>
        <translation>経路の {registered:.0f} % が位置合わせ済みです。全経路の水平位置の標準偏差は {sigma:.1f} cm（中央値）です。</translation>
    </message>
    <message>
        <source> {distrusted:.0f} % is not to be trusted: leave it out, or measure it otherwise; the table below tells where.</source>
        <translation> {distrusted:.0f} % は信頼できません。除くか別の方法で計測してください。場所は下の表にあります。</translation>
    </message>
    <message>
        <source>Look at the markings before and after below: where they lie on the reference, use the result.</source>
        <translation>下の補正前後の路面標示を確認し、基準に一致していれば結果を使えます。</translation>
    </message>
    <message>
        <source>Path length (m)</source>
        <translation>経路長 (m)</translation>
    </message>
    <message>
        <source>Registered (% of the path)</source>
        <translation>位置合わせ済み（経路の %）</translation>
    </message>
    <message>
        <source>Bridged (%)</source>
        <translation>補間 (%)</translation>
    </message>
    <message>
        <source>Not to be trusted (%)</source>
        <translation>信頼できない区間 (%)</translation>
    </message>
    <message>
        <source>Correction in plan, mean and maximum (m)</source>
        <translation>水平の補正量、平均と最大 (m)</translation>
    </message>
    <message>
        <source>Standard deviation in plan over the whole path, median and maximum (m)</source>
        <translation>全経路の水平位置の標準偏差、中央値と最大（m）</translation>
    </message>
    <message>
        <source>Correction of the reported positions. Look for steps and spikes: a trajectory drifts smoothly, and jumps only where its satellites were lost or found again.</source>
        <translation>報告された位置の補正量。段差や突出を探してください。軌跡は滑らかにずれ、衛星を失うか再捕捉した所でだけ跳びます。</translation>
    </message>
    <message>
        <source>Standard deviation of the correction. It grows where markings are few or run one way only.</source>
        <translation>補正量の標準偏差。路面標示が少ない所や一方向だけの所で大きくなります。</translation>
    </message>
    <message>
        <source>Share of a window's marking points that lie on reference markings. Where it falls, paint has changed or the match is wrong.</source>
        <translation>ウィンドウの路面標示点のうち基準上にある割合。下がる所では、標示が変わったか照合が誤っています。</translation>
    </message>
    <message>
        <source>The correction steps here, and a trajectory does not. Between two edges of changed markings the road was painted anew: the correction bridges them. Of a single step nobody can say from markings alone which side is right: a frame of the reference may be off, or the road beyond was painted anew; the standard deviations of both sides hold either.</source>
        <translation>補正量がここで段差になっていますが、軌跡に段差は生じません。変化した標示の両端の間は塗り直されており、補正はその間を補間します。段差が一つだけの場合、標示だけではどちらの側が正しいか判断できません。基準の写真がずれているか、その先の道路が塗り直された可能性があり、両側の標準偏差はいずれの場合も含みます。</translation>
    </message>
    <message>
        <source>The road that this concerns, as the layer of areas has it:</source>
        <translation>該当する道路区間（範囲レイヤと同じ）：</translation>
    </message>
    <message>
        <source>Marking points of the survey over the aerial image: left as reported (red), right corrected (green). A picture is {side:.0f} m wide.</source>
        <translation>空中写真に重ねたMMSの路面標示の点です。左は補正前（赤）、右は補正後（緑）。画像の幅は {side:.0f} m です。</translation>
    </message>
    <message>
        <source>Marking points of the survey over the reference markings: left as reported (red), right corrected (green). A picture is {side:.0f} m wide.</source>
        <translation>基準の路面標示に重ねたMMSの路面標示の点です。左は補正前（赤）、右は補正後（緑）。画像の幅は {side:.0f} m です。</translation>
    </message>
    <message>
        <source>Reference and survey disagree, and nobody can say from the markings alone which is right: no part of the path is registered. Check the reference at the places below.</source>
        <translation>基準と計測が一致せず、標示だけではどちらが正しいか判断できません。走行経路のどの部分も位置合わせされていません。下記の箇所で基準を確認してください。</translation>
    </message>
    <message>
        <source>Correction in height, mean and maximum (m)</source>
        <translation>高さの補正量、平均と最大 (m)</translation>
    </message>
    <message>
        <source>Standard deviation in height over the whole path, median and maximum (m)</source>
        <translation>全経路の高さの標準偏差、中央値と最大（m）</translation>
    </message>
    <message>
        <source>Standard deviation in plan relative to the reference, median and maximum (m)</source>
        <translation>基準に対する水平位置の標準偏差、中央値と最大値（m）</translation>
    </message>
    <message>
        <source>Stated accuracy of the reference in plan (m)</source>
        <translation>指定された基準の水平精度（m）</translation>
    </message>
    <message>
        <source>Steps of the reference are told from, median and maximum along the path (m)</source>
        <translation>検出できる基準の段差の下限、経路に沿った中央値と最大値（m）</translation>
    </message>
    <message>
        <source>Drift, times the expected one</source>
        <translation>ドリフト（想定に対する倍率）</translation>
    </message>
    <message>
        <source>Variance of the observations, times the stated one</source>
        <translation>観測値の分散（設定値に対する倍率）</translation>
    </message>
    <message>
        <source>Distance of each window's own correction from the smooth one, in plan. Windows that stand out saw something else than the reference.</source>
        <translation>各ウィンドウ自身の補正量と平滑化後の水平距離。突出するウィンドウは基準と違う物を見ています。</translation>
    </message>
    <message>
        <source>Registering {markings_count:,} marking points.</source>
        <translation>{markings_count:,} 点の路面標示点を位置合わせしています。</translation>
    </message>
    <message>
        <source>No part of the survey could be registered to the reference markings, so that there is no result: check that both show the same roads, and the maximum error.</source>
        <translation>計測データのどの部分も基準の路面標示に位置合わせできなかったため、結果はありません。両方が同じ道路を示しているか、および最大誤差を確認してください。</translation>
    </message>
    <message>
        <source>{path} has {bands} bands and is an image, no mask of road markings: {advice}.</source>
        <translation>{path}は {bands} バンドの画像で、路面標示のマスクではありません。{advice}。</translation>
    </message>
    <message>
        <source>{path} is above 0 in {marked:.0f} % of its cells, so that it is no mask of road markings: {advice}.</source>
        <translation>{path}はセルの {marked:.0f} % が0より大きく、路面標示のマスクではありません。{advice}。</translation>
    </message>
    <message>
        <source>{path} holds no road marking: no cell is above 0; {advice}, or give that of another place.</source>
        <translation>{path}に路面標示がありません。0より大きいセルがありません。{advice}。または別の場所のものを指定してください。</translation>
    </message>
    <message>
        <source>{path} has many different values and is an image or a surface, no mask of road markings: {advice}.</source>
        <translation>{path}は多数の異なる値を持つ画像または表層データで、路面標示のマスクではありません。{advice}。</translation>
    </message>
    <message>
        <source>The trajectory drives {chainage:.2f} m, less than one patch of {length:g} m: give a longer one.</source>
        <translation>軌跡の走行距離 {chainage:.2f} m が1パッチ {length:g} m より短くなっています。より長い軌跡を指定してください。</translation>
    </message>
    <message>
        <source>The survey lies {middle:.1f} m {value} the reference's ground: heights above the ellipsoid and above sea level cannot be mixed, convert one of the two.</source>
        <translation>計測データが基準の地表面より {middle:.1f} m {value}にあります。楕円体高と標高は混在できません。どちらかを変換してください。</translation>
    </message>
    <message>
        <source>The reference markings must be polygons and at least one: choose another layer.</source>
        <translation>基準の路面標示は1つ以上のポリゴンである必要があります。別のレイヤを選択してください。</translation>
    </message>
    <message>
        <source>{path} has cells of {cell:g} m: road markings need {coarsest:g} m or less, and a CRS in metres.</source>
        <translation>{path}のセルは {cell:g} m です。路面標示には {coarsest:g} m 以下のセルと、メートル単位のCRSが必要です。</translation>
    </message>
    <message>
        <source>below</source>
        <translation>下</translation>
    </message>
    <message>
        <source>above</source>
        <translation>上</translation>
    </message>
    <message>
        <source>There is no reference marking near the survey: check the CRS of both and that the reference covers the drive.</source>
        <translation>計測データの近くに基準の路面標示がありません。両方のCRSと、基準データが走行範囲を覆っているか確認してください。</translation>
    </message>
    <message>
        <source>Taking road markings out of the survey.</source>
        <translation>計測データから路面標示を抽出しています。</translation>
    </message>
    <message>
        <source>No road marking was found in the survey: check its intensities with “Road markings of a mobile survey”.</source>
        <translation>計測データに路面標示が見つかりません。「MMS計測の路面標示」で反射強度を確認してください。</translation>
    </message>
    <message>
        <source>The attribute {weight} of {paths} holds values below 0: give markings as “Road markings of a mobile survey” writes them, or the survey itself.</source>
        <translation>{paths}の属性{weight}に0未満の値があります。「MMS計測の路面標示」が出力した路面標示か、計測データ自体を指定してください。</translation>
    </message>
    <message>
        <source>The airborne laser points show no wall where the survey saw facades: check that both lie in one place and have one height system.</source>
        <translation>計測に建物正面が写った場所で、航空レーザ点群に壁が見つかりません。両者の場所と高さの基準が同じであることを確認してください。</translation>
    </message>
    <message>
        <source>The survey shows no facade near the vehicle: give all its points, not the markings alone, or register it by its markings.</source>
        <translation>計測点群の車両付近に壁面がありません。標示だけでなく全点を指定するか、標示だけで位置合わせしてください。</translation>
    </message>
    <message>
        <source>{path} is in latitude and longitude: the coordinate reference system of the survey must be known; store it in the point cloud or give it.</source>
        <translation>{path}は緯度・経度です。計測データの座標参照系が必要です。点群に保存するか、指定してください。</translation>
    </message>
    <message>
        <source>{path} is no SBET file: its latitudes are no angles in radians.</source>
        <translation>{path}はSBETファイルではありません。緯度がラジアンの角度ではありません。</translation>
    </message>
    <message>
        <source>{path} has no number in record {bad}: export it again, or remove the record.</source>
        <translation>{path}のレコード {bad} に数値がありません。再度出力するか、レコードを削除してください。</translation>
    </message>
    <message>
        <source>{path}: its angles are no radians, as those of an SBET are: export it again.</source>
        <translation>{path}: 角度がSBETのようなラジアンではありません。再度出力してください。</translation>
    </message>
    <message>
        <source>{path} lies outside the coordinate reference system of the survey at record {bad}: choose the right one.</source>
        <translation>{path}のレコード {bad} が計測データの座標参照系の範囲外にあります。正しい座標参照系を選択してください。</translation>
    </message>
    <message>
        <source>UTC against GPS time, 18 s since 2017 and 17 s before</source>
        <translation>UTC と GPS 時の差。2017年以降は18秒、それ以前は17秒</translation>
    </message>
    <message>
        <source>UTC against TAI, 37 s since 2017 and 36 s before</source>
        <translation>UTC と TAI の差。2017年以降は37秒、それ以前は36秒</translation>
    </message>
    <message>
        <source>The points of {name} lie {now:.0f} m (median) from where the vehicle was at their times, but {near:.0f} m from where it was about {seconds:.0f} s {value}: their clocks seem to differ{clocks}.</source>
        <translation>{name} の点は、その時刻の車両位置から {now:.0f} m（中央値）離れていますが、約 {seconds:.0f} 秒{value}の車両位置からは {near:.0f} m です。点群と軌跡の時計がずれているようです{clocks}。</translation>
    </message>
    <message>
        <source>give both of one survey, in one coordinate reference system</source>
        <translation>同じ計測の両方を、同じ座標参照系で指定してください</translation>
    </message>
    <message>
        <source>x and y are swapped in one of them: swap them</source>
        <translation>一方のxとyが入れ替わっています。入れ替えてください</translation>
    </message>
    <message>
        <source>the trajectory looks like latitudes and longitudes in degrees; give it in the points' projected system</source>
        <translation>軌跡が度の緯度・経度のようです。点群の投影座標系で指定してください</translation>
    </message>
    <message>
        <source>{name} lies {length} from where the vehicle was at its times: {reason}.</source>
        <translation>{name}は、その時刻の車両の位置から{length}離れています: {reason}。</translation>
    </message>
    <message>
        <source>All points of {name} lie more than {above:.0f} m {value} the trajectory: heights above the ellipsoid and above sea level cannot be mixed; convert one of them (a geoid model can be given for SBET).</source>
        <translation>{name}の全点が軌跡より{value}に {above:.0f} m 以上離れています。楕円体高と標高は混在できません。どちらかを変換してください（SBETにはジオイドモデルを指定できます）。</translation>
    </message>
    <message>
        <source>the trajectory is in {unit}; give it in metres</source>
        <translation>軌跡の単位が {unit} です。メートルで指定してください</translation>
    </message>
    <message>
        <source>The reference markings</source>
        <translation>基準の路面標示</translation>
    </message>
    <message>
        <source>later</source>
        <translation>後</translation>
    </message>
    <message>
        <source>earlier</source>
        <translation>前</translation>
    </message>
    <message>
        <source>The ground elevation</source>
        <translation>地表の標高</translation>
    </message>
    <message>
        <source>{what} {reach} {length} from the path of the survey: give those of the same place.</source>
        <translation>{what}が計測の走行経路から{length}離れています。同じ場所のものを指定してください。</translation>
    </message>
    <message>
        <source>{what} cover{value} {share:.0f} % of the path only: the rest cannot be registered.</source>
        <translation>{what}は走行経路の {share:.0f} % しか覆っていません。残りは位置合わせできません。</translation>
    </message>
    <message>
        <source>The vehicle is {middle:.0f} m {value} the ground elevation: heights above the ellipsoid and above sea level cannot be mixed, convert one of the two (a geoid model can be given for SBET).</source>
        <translation>車両が地表の標高より {middle:.0f} m {value}にあります。楕円体高と標高は混在できません。どちらかを変換してください（SBETにはジオイドモデルを指定できます）。</translation>
    </message>
    <message>
        <source>{paths} holds no usable points: all are noise, withheld or have no valid height.</source>
        <translation>{paths}に使用できる点がありません。すべてノイズ、除外指定（withheld）、または高さが無効な点です。</translation>
    </message>
    <message>
        <source>The trajectory runs from {time:.3f} to {time_2:.3f} s, but a pose is needed at {worst:.3f} s: give the trajectory of the whole survey.</source>
        <translation>軌跡は {time:.3f}～{time_2:.3f} s ですが、{worst:.3f} s の位置姿勢が必要です。計測全体の軌跡を指定してください。</translation>
    </message>
    <message>
        <source>{who} overlap in time: give times that count on over the weeks (full GPS seconds), or each place of the vehicle once.</source>
        <translation>時刻が重複しています（{who}）。週をまたいで連続する時刻（通算GPS秒）で与えるか、車両の各位置を1回だけ指定してください。</translation>
    </message>
    <message>
        <source>{name} states the accuracy of its places: {usual:.2f} m (median), at most {most:.2f} m.</source>
        <translation>{name}の示す位置の精度：{usual:.2f} m（中央値）、最大{most:.2f} m。</translation>
    </message>
    <message>
        <source>{name} states the accuracy of the angles: roll {roll:.3f}°, pitch {pitch:.3f}°, heading {heading:.3f}° (medians).</source>
        <translation>{name} の角度の精度：ロール {roll:.3f}°、ピッチ {pitch:.3f}°、方位 {heading:.3f}°（中央値）。</translation>
    </message>
    <message>
        <source>{name} has {there} but no {missing}: give the standard deviations of all three angles, or of none.</source>
        <translation>{name}には{there}がありますが、{missing}がありません。3つの角度すべての標準偏差を与えるか、すべて省略してください。</translation>
    </message>
    <message>
        <source>{name} states the accuracy of {there} alone: give those of easting and northing (sd_x, sd_y), or none.</source>
        <translation>{name}には{there}の精度だけがあります。東方向と北方向（sd_x、sd_y）の両方を与えるか、どちらも除いてください。</translation>
    </message>
    <message>
        <source>{path} is no RMS file of an SBET or is cut off: its length is no multiple of {itemsize} bytes; export it again, or put it elsewhere.</source>
        <translation>{path}はSBETのRMSファイルではないか、途中で切れています。長さが {itemsize} バイトの倍数ではありません。再度出力するか、別の場所に移してください。</translation>
    </message>
    <message>
        <source>{path} does not belong to the trajectory: its times run from {time:.1f} to {time_2:.1f} s, the trajectory's from {time_3:.1f} to {time_4:.1f} s; give that of the same solution, or put it elsewhere.</source>
        <translation>{path}は軌跡に対応していません。時刻は {time:.1f}～{time_2:.1f} s ですが、軌跡は {time_3:.1f}～{time_4:.1f} s です。同じ解析結果のものを与えるか、別の場所に移してください。</translation>
    </message>
    <message>
        <source>{name} holds a standard deviation of an angle that is not above 0 and below 90 degrees: correct or remove it.</source>
        <translation>{name}に、0度より大きく90度未満でない角度の標準偏差があります。修正するか、削除してください。</translation>
    </message>
    <message>
        <source>{name} holds a standard deviation of a place that is not above 0 m: correct or remove it.</source>
        <translation>{name}に0 m以下の位置の標準偏差があります。修正するか除いてください。</translation>
    </message>
    <message>
        <source>{name} has no column {missing}: a trajectory needs {columns}.</source>
        <translation>{name}に列{missing}がありません。軌跡には{columns}が必要です。</translation>
    </message>
    <message>
        <source>{name} has {table_count} epochs: give a trajectory of at least two.</source>
        <translation>{name}のエポック数は {table_count} です。2エポック以上の軌跡を指定してください。</translation>
    </message>
    <message>
        <source>{name}: a geoid is applied to the ellipsoidal heights of SBET only; these heights stay as they are.</source>
        <translation>{name}：ジオイドはSBETの楕円体高にだけ適用します。この高さはそのままです。</translation>
    </message>
    <message>
        <source>{name}: {count} epochs are out of order; they were sorted by time.</source>
        <translation>{name}：順序の乱れたエポック {count} 件を時刻順に並べました。</translation>
    </message>
    <message>
        <source>{name}: {same_count} epochs are repeated; each was taken once.</source>
        <translation>{name}：重複するエポック {same_count} 件は一度だけ使いました。</translation>
    </message>
    <message>
        <source>{name} has one epoch only: give a trajectory of at least two.</source>
        <translation>{name}は1エポックしかありません。2エポック以上の軌跡を指定してください。</translation>
    </message>
    <message>
        <source>has no epochs for more than a second</source>
        <translation>に1秒を超える欠測があります</translation>
    </message>
    <message>
        <source>jumps</source>
        <translation>で跳んでいます</translation>
    </message>
    <message>
        <source>The times of {name} are rounded to {step:g} s: {count} epochs of different poses share their time with another. Export it with more decimals of the time.</source>
        <translation>{name} の時刻は {step:g} 秒に丸められています。位置や姿勢の異なる {count} 個のエポックが、ほかと同じ時刻になっています。時刻の小数点以下の桁数を増やして書き出してください。</translation>
    </message>
    <message>
        <source>{name} gives two different poses for the time {time:.4f} s: remove the wrong one.</source>
        <translation>{name}に時刻 {time:.4f} s の異なる位置姿勢が2つあります。誤っている方を削除してください。</translation>
    </message>
    <message>
        <source>{name} {what} at {places}{more}: what was measured there is not to be trusted.</source>
        <translation>{name}：{places}{more} {what}。そこでの計測は信頼できません。</translation>
    </message>
    <message>
        <source>A trajectory that came as a layer is written as a layer.</source>
        <translation>レイヤとして入力された軌跡は、レイヤとして出力されます。</translation>
    </message>
    <message>
        <source>{name}: {unit} {row} (time {time:.4f} s) lies {length:.0f} km from its neighbour, where no vehicle can have been: correct or remove it.</source>
        <translation>{name}：{unit} {row}（時刻 {time:.4f} 秒）は隣の行から {length:.0f} km 離れており、車両が走行できる位置ではありません。修正するか削除してください。</translation>
    </message>
    <message>
        <source>{name}: {unit} {row} (time {time:.4f} s) has an angle of {angle:g} degrees, which no vehicle has: correct or remove it.</source>
        <translation>{name}: {unit} {row}(時刻 {time:.4f} 秒)の角度 {angle:g} 度は車両としてありえません。直すか除いてください。</translation>
    </message>
    <message>
        <source>{name}: the time {time:.1f} s of {unit} {row} lies more than a week from its neighbour's: correct or remove it, or give surveys one by one.</source>
        <translation>{name}：{unit} {row} の時刻 {time:.1f} 秒は隣の行から 1 週間以上離れています。修正または削除するか、計測を 1 回ずつ指定してください。</translation>
    </message>
    <message>
        <source>degrees clockwise from grid north</source>
        <translation>度、座標北から時計回り</translation>
    </message>
    <message>
        <source>radians clockwise from grid north</source>
        <translation>ラジアン、座標北から時計回り</translation>
    </message>
    <message>
        <source>degrees counter-clockwise from east</source>
        <translation>度、東から反時計回り</translation>
    </message>
    <message>
        <source>radians counter-clockwise from east</source>
        <translation>ラジアン、東から反時計回り</translation>
    </message>
    <message>
        <source>{name}: angles of up to {max:.0f} are no radians: they are degrees; say so.</source>
        <translation>{name}: 最大 {max:.0f} の角度はラジアンではなく度です。度であることを指定してください。</translation>
    </message>
    <message>
        <source>{name}: the headings lie {off:.0f}° beside the direction of travel (median), but read as {angle_names} they go with it ({away:.1f}°): say that the angles are counted so, or convert them to {angle_names_2}.</source>
        <translation>{name}: 方位が進行方向から {off:.0f}°（中央値）ずれていますが、{angle_names}として読むと進行方向と一致します（{away:.1f}°）。角度をそのように指定するか、{angle_names_2}に変換してください。</translation>
    </message>
    <message>
        <source>{name} holds no attitude: roll, pitch and heading are {angles} at all epochs. Mounting angles and corrections of the attitude are wrong by it; export the trajectory with its angles.</source>
        <translation>{name} には姿勢がありません。すべてのエポックでロール、ピッチ、方位角が {angles} です。このままでは取付角や姿勢の補正が誤ります。角度を付けて軌跡を書き出してください。</translation>
    </message>
    <message>
        <source>{name}: the vehicle drove backwards, or its headings are half a turn off: they point against the direction of travel.</source>
        <translation>{name}：車両が後退したか、方位が半回転ずれています。方位が進行方向と逆です。</translation>
    </message>
    <message>
        <source>{name}: the headings lie {off:.0f}° beside the direction of travel (median): where the body's x axis does not point forward, the calibration must say the same; otherwise the headings are wrong.</source>
        <translation>{name}：方位が進行方向から {off:.0f}° ずれています（中央値）。車体のx軸が前方を向かない場合は校正値も同じでなければなりません。そうでなければ方位が誤っています。</translation>
    </message>
    <message>
        <source>offset</source>
        <translation>全体のずれ</translation>
    </message>
    <message>
        <source>added</source>
        <translation>追加</translation>
    </message>
    <message>
        <source>removed</source>
        <translation>撤去</translation>
    </message>
    <message>
        <source>repainted</source>
        <translation>塗り替え</translation>
    </message>
    <message>
        <source>The old map has no lines to compare.</source>
        <translation>旧地図に比べる線がありません。</translation>
    </message>
    <message>
        <source>The new map has no lines to compare.</source>
        <translation>新地図に比べる線がありません。</translation>
    </message>
    <message>
        <source>The maps do not overlap: the old one lies within {old}, the new one within {new} (x and y from, x and y to, m). Check that both are of one place and in one coordinate reference system.</source>
        <translation>地図が重なりません。旧地図は {old}、新地図は {new} にあります（x・y の最小、x・y の最大、m）。同じ場所で、同じ座標参照系の地図か確認してください。</translation>
    </message>
    <message>
        <source>along</source>
        <translation>進行方向</translation>
    </message>
    <message>
        <source>across</source>
        <translation>横断方向</translation>
    </message>
    <message>
        <source>Give a map with marking lines, road borders or other bounds on the ground; virtual ones are not compared.</source>
        <translation>標示の線、道路縁など地上の境界線のある地図を指定してください。仮想の境界線は比べません。</translation>
    </message>
    <message>
        <source>symbol</source>
        <translation>記号</translation>
    </message>
    <message>
        <source>double {kind}</source>
        <translation>二重 {kind}</translation>
    </message>
    <message>
        <source>One of the maps has only local coordinates (local_x, local_y), the other latitudes and longitudes: give both in one kind.</source>
        <translation>一方の地図はローカル座標（local_x, local_y）だけ、他方は緯度・経度です。同じ種類の座標で指定してください。</translation>
    </message>
    <message>
        <source>The Lanelet2 file has only local coordinates (local_x, local_y): it can be compared with another such file, but not with layers or with latitudes and longitudes.</source>
        <translation>この Lanelet2 ファイルにはローカル座標（local_x, local_y）しかありません。同じ種類のファイルとは比べられますが、レイヤや緯度・経度の地図とは比べられません。</translation>
    </message>
    <message>
        <source>Places of the Lanelet2 file lie outside of the CRS of the comparison: check whether both maps are of one place.</source>
        <translation>Lanelet2 ファイルの位置が、比較の座標参照系の範囲外です。同じ場所の地図か確認してください。</translation>
    </message>
    <message>
        <source>its face is not seen: it lies between the last points before and the first behind</source>
        <translation>面が見えません：手前の最後の点と奥の最初の点の間にあります</translation>
    </message>
    <message>
        <source>most of it is hidden</source>
        <translation>大部分が隠れています</translation>
    </message>
    <message>
        <source>the surface changes gradually</source>
        <translation>面が徐々に変わっています</translation>
    </message>
    <message>
        <source>it is short and lower than the steps that show surely in this survey</source>
        <translation>短く、この計測で確実に見える段差より低い</translation>
    </message>
    <message>
        <source>no kerb lies before it: it may be the side of a vehicle</source>
        <translation>手前に縁石がありません：車両の側面の可能性があります</translation>
    </message>
    <message>
        <source>it is as long and high as a car</source>
        <translation>乗用車と同じ長さと高さです</translation>
    </message>
    <message>
        <source>There are {found:.1f} ground points a square metre beside the path: edges need {sparse:.0f} or more; give the whole survey, not a thinned one.</source>
        <translation>軌跡の脇の地表面点は1 m²あたり{found:.1f}点です。道路端の抽出には{sparse:.0f}点以上が必要です。間引いていない全計測データを指定してください。</translation>
    </message>
    <message>
        <source>No point of {paths} was measured beside the path at the height of its road: give points and trajectory of one drive, in one coordinate and height system.</source>
        <translation>{paths}には、軌跡の脇で路面の高さに計測された点がありません。同じ座標参照系・高さの基準の、同一走行の点群と軌跡を指定してください。</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>計測</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>不確か</translation>
    </message>
    <message>
        <source>The survey shows no kerb beside the path: give all its points, not the markings alone, or register it without road edges.</source>
        <translation>計測の経路のそばに縁石が写っていません。路面標示だけでなくすべての点を与えるか、道路縁を使わずに位置合わせしてください。</translation>
    </message>
    <message>
        <source>No line of the road edges lies where the survey shows kerbs: check that both show the same streets.</source>
        <translation>計測に縁石が写っている所に道路縁の線がありません。両者が同じ街路のものか確認してください。</translation>
    </message>
    <message>
        <source>something taller stands right behind it: it may be a row of vehicles</source>
        <translation>すぐ後ろに、より高い物があります：車列の可能性があります</translation>
    </message>
    <message>
        <source>it does not reach the ground: it may be the side of a vehicle</source>
        <translation>地面に届いていません：車両の側面の可能性があります</translation>
    </message>
    <message>
        <source>Places of the map have no latitude and longitude in its CRS: check the CRS of the lines.</source>
        <translation>地図の位置を座標参照系から緯度経度に変換できません。線の座標参照系を確認してください。</translation>
    </message>
    <message>
        <source>The map lies in more than one MGRS square, in which Autoware's local coordinates would repeat: take the projector TransverseMercator.</source>
        <translation>地図が複数のMGRS区画にまたがるため、Autowareのローカル座標が重複します。投影法TransverseMercatorを使用してください。</translation>
    </message>
    <message>
        <source>The lines' CRS cannot be brought to latitude and longitude, which a Lanelet2 file needs: assign a projected CRS known to PROJ.</source>
        <translation>線の座標参照系を、Lanelet2ファイルに必要な緯度経度に変換できません。PROJで扱える投影座標参照系を設定してください。</translation>
    </message>
    <message>
        <source>{number} objects stand beside no road of the map: they are missing in the OpenDRIVE file.</source>
        <translation>{number} 個の地物は地図のどの道路の脇にもありません。OpenDRIVE のファイルには含まれません。</translation>
    </message>
    <message>
        <source>The lines' CRS cannot be written as a PROJ string, which OpenDRIVE needs: assign a projected CRS known to PROJ.</source>
        <translation>線の座標参照系を、OpenDRIVEに必要なPROJ文字列で表せません。PROJで扱える投影座標参照系を設定してください。</translation>
    </message>
    <message>
        <source>Lane {one} leads to lane {other}, but OpenDRIVE knows one road or junction at the end of a road: the connection is missing in the OpenDRIVE file.</source>
        <translation>車線{one}は車線{other}に通じていますが、OpenDRIVEでは道路の端に接続できる道路または交差点は1つだけです。この接続はOpenDRIVEファイルに含まれません。</translation>
    </message>
    <message>
        <source>No light or sign is known here: who yields is inferred ({reasons}) for {pairs} pairs of ways. Check it before anything drives by it.</source>
        <translation>ここでは信号も標識も分かっていません。通行路 {pairs} 組の優先関係は推定です（{reasons}）。走行に使う前に確認してください。</translation>
    </message>
    <message>
        <source>A drive leads from one lane to another here, but bounds along it would cross; no virtual lane was made.</source>
        <translation>ここでは走行がある車線から別の車線へ通じていますが、それに沿う境界線が交差するため、仮想車線は作成しませんでした。</translation>
    </message>
    <message>
        <source>A drive leads from one lane to another here, but bounds along it would cross; they are drawn at a lane's width about a smooth curve.</source>
        <translation>ここでは走行がある車線から別の車線へ通じていますが、それに沿う境界線が交差するため、滑らかな曲線の両側に車線幅で描きました。</translation>
    </message>
    <message>
        <source>A drive runs {end:.0f} m outside all lanes here: lines are missing, or were not seen.</source>
        <translation>ここでは走行が{end:.0f} mにわたり全車線の外を通っています。線が欠けているか、計測されていません。</translation>
    </message>
    <message>
        <source>The bound is drawn through {unseen:.1f} m without a line.</source>
        <translation>境界線は、線のない{unseen:.1f} mの区間を通して描かれています。</translation>
    </message>
    <message>
        <source>A strip of lane width ({width:.1f} m wide, {end:.0f} m long) shows neither drive nor arrow nor a lane line to a lane beside it; no lane was made.</source>
        <translation>車線幅の帯（幅{width:.1f} m、長さ{end:.0f} m）に、走行も矢印も隣接車線との車線境界線もないため、車線を作成しませんでした。</translation>
    </message>
    <message>
        <source>This lane is {width:.1f} m wide between its line and the edge of the road: it may be two, or have room to stop beside it.</source>
        <translation>この車線は線と道路端の間の幅が{width:.1f} mです。2車線か、横に停車する余地があるかもしれません。</translation>
    </message>
    <message>
        <source>road axis</source>
        <translation>道路中心線</translation>
    </message>
    <message>
        <source>beyond the junction</source>
        <translation>交差点の向こう側</translation>
    </message>
    <message>
        <source>beside a dashed line</source>
        <translation>破線の隣</translation>
    </message>
    <message>
        <source>across the centre line</source>
        <translation>中央線の反対側</translation>
    </message>
    <message>
        <source>drive</source>
        <translation>走行</translation>
    </message>
    <message>
        <source>arrow or stop line</source>
        <translation>矢印または停止線</translation>
    </message>
    <message>
        <source>inferred from arrows</source>
        <translation>矢印から推定</translation>
    </message>
    <message>
        <source>inferred from the rule of the road</source>
        <translation>通行方法の規則から推定</translation>
    </message>
    <message>
        <source>straight on</source>
        <translation>直進</translation>
    </message>
    <message>
        <source>to the left</source>
        <translation>左折</translation>
    </message>
    <message>
        <source>to the right</source>
        <translation>右折</translation>
    </message>
    <message>
        <source>By the rule of the road a way {turn} is possible from this lane (confidence {confidence:.2f}), but no arrow or drive shows it; it is not in the map.</source>
        <translation>通行区分の原則によればこの車線から{turn}できる可能性があります（信頼度 {confidence:.2f}）が、矢印も走行軌跡もそれを示していないため、地図には入れていません。</translation>
    </message>
    <message>
        <source>A drive runs between lines that leave less than a lane: {min:.1f} m, for {span:.0f} m; no lane was made.</source>
        <translation>走行が通る線の間隔が車線幅に足りません（{min:.1f} m、{span:.0f} mにわたる）。車線は作成しませんでした。</translation>
    </message>
    <message>
        <source>turns across the oncoming traffic</source>
        <translation>対向車線を横切って曲がる</translation>
    </message>
    <message>
        <source>fewer lanes</source>
        <translation>車線数が少ない</translation>
    </message>
    <message>
        <source>narrower road</source>
        <translation>幅員が狭い</translation>
    </message>
    <message>
        <source>side it comes from</source>
        <translation>進入してくる側</translation>
    </message>
    <message>
        <source>Drives, arrows or stop lines contradict each other about the direction here.</source>
        <translation>ここでは方向について、走行、矢印、停止線が互いに矛盾しています。</translation>
    </message>
    <message>
        <source>Arrows or stop lines contradict the drives about the direction here; that of the drives was taken.</source>
        <translation>ここでは方向について、矢印または停止線が走行と矛盾しています。走行の方向を採用しました。</translation>
    </message>
    <message>
        <source>The drive keeps to the other direction's side of the centre line here; the lane was made as it was driven.</source>
        <translation>ここでは走行が中央線の反対方向の側を通っています。車線は走行どおりに作りました。</translation>
    </message>
    <message>
        <source>The points cover whole surfaces, not paint: give marking points, as road markings from mobile surveys make them, not the survey itself.</source>
        <translation>点が標示ではなく面全体を覆っています。計測そのものではなく、MMS計測の路面標示が作る路面標示点を指定してください。</translation>
    </message>
    <message>
        <source>No marking point lies near the road markings: check that both are of the same place and that their coordinate reference systems are right.</source>
        <translation>標示の点が路面標示の近くに一つもありません。両方が同じ場所のものか、座標参照系が正しいか確認してください。</translation>
    </message>
    <message>
        <source>This signal hangs above no lane that leads away from a stop line: it is written as a pole alone.</source>
        <translation>この信号機は、停止線から先へ続く車線の上にありません。柱としてだけ書きます。</translation>
    </message>
    <message>
        <source>This signal is doubtful: it is written as a pole alone.</source>
        <translation>この信号機は不確実です。柱としてだけ書きます。</translation>
    </message>
    <message>
        <source>No arm tells where the head of this signal hangs: it is written as a pole alone.</source>
        <translation>この信号機の灯器の位置を示す腕木がありません。柱としてだけ書きます。</translation>
    </message>
    <message>
        <source>This signal hangs above lanes to {fits} stop lines of different directions: it is written as a pole alone.</source>
        <translation>この信号機は、向きの異なる {fits} 本の停止線の車線の上にあります。柱としてだけ書きます。</translation>
    </message>
    <message>
        <source>Line {row} of the layer has a corner whose east or north is no number or off the earth: mend the corner or delete the line.</source>
        <translation>レイヤの {row} 行目の線に、座標が数値でない、または地球上にあり得ない頂点があります。頂点を修正するか、その線を削除してください。</translation>
    </message>
    <message>
        <source>Line {row} of the layer has a straight side of {side:.0f} km, longer than any road's: mend its corners or delete the line.</source>
        <translation>レイヤの {row} 行目の線に、道路としてあり得ない長さ（{side:.0f} km）の直線区間があります。頂点を修正するか、その線を削除してください。</translation>
    </message>
    <message>
        <source>other things stand close beside it</source>
        <translation>すぐ近くに別のものがある</translation>
    </message>
    <message>
        <source>other upright</source>
        <translation>その他の立体物</translation>
    </message>
    <message>
        <source>its post is not seen</source>
        <translation>支柱が見えていない</translation>
    </message>
    <message>
        <source>half of its board may be hidden</source>
        <translation>板の半分が隠れている可能性がある</translation>
    </message>
    <message>
        <source>it stands in the crown of a tree</source>
        <translation>樹冠の中に立っています</translation>
    </message>
    <message>
        <source>few points</source>
        <translation>点不足</translation>
    </message>
    <message>
        <source>it may be a part of a wall</source>
        <translation>壁の一部の可能性がある</translation>
    </message>
    <message>
        <source>its foot is hidden</source>
        <translation>根元が隠れている</translation>
    </message>
    <message>
        <source>its stem is seen in parts</source>
        <translation>柱・幹が部分的にしか見えない</translation>
    </message>
    <message>
        <source>A line nearly worn away, taken from faint paint where the width of the lanes asks for one: look at it.</source>
        <translation>ほとんど消えた線です。車線幅から線があるはずの所の薄い標示から得ました。確認してください。</translation>
    </message>
    <message>
        <source>The edge of the road is the border of its surface in the orthophoto, not a kerb that was measured (sigma {sigma:.2f} m).</source>
        <translation>この道路端はオルソ画像での路面の境で、計測した縁石ではありません（標準偏差{sigma:.2f} m）。</translation>
    </message>
    <message>
        <source>No trajectory was given: only arrows and stop lines tell directions, and ways through junctions are inferred.</source>
        <translation>軌跡が指定されていません。方向は矢印と停止線だけから判断し、交差点内の進路は推定によります。</translation>
    </message>
    <message>
        <source>{filled} of {nodes_count} nodes have no measured height: theirs is taken from along the road (sigma up to {far:.2f} m).</source>
        <translation>{nodes_count} 点のうち {filled} 点は高さが計測されていないため、道路に沿った前後の高さから補いました（標準偏差は最大 {far:.2f} m）。</translation>
    </message>
    <message>
        <source>No drive shows where this lane leads to.</source>
        <translation>この車線の行き先を示す走行がありません。</translation>
    </message>
    <message>
        <source>No drive shows where this lane comes from.</source>
        <translation>この車線がどこから来るかを示す走行がありません。</translation>
    </message>
    <message>
        <source>No lane of the map ends at this stop line.</source>
        <translation>この停止線で終わる車線が地図にありません。</translation>
    </message>
    <message>
        <source>No node has a height; give the marking lines a ground.</source>
        <translation>高さのある点が一つもありません。区画線に地盤を指定してください。</translation>
    </message>
    <message>
        <source>{code} is no code of a road's function: give one of {codes}.</source>
        <translation>{code} は道路の機能のコードではありません。{codes} のいずれかを指定してください。</translation>
    </message>
    <message>
        <source>{uncut} of {arms} roads that meet here have no corner at which to cut: cut them by hand.</source>
        <translation>ここで接続する道路 {arms} 本のうち {uncut} 本に、区切るための道路角がありません。手作業で区切ってください。</translation>
    </message>
    <message>
        <source>Two junctions that could not be parted: look whether they are one.</source>
        <translation>二つの交差部を分けられませんでした。一つの交差部かどうか確認してください。</translation>
    </message>
    <message>
        <source>The layer holds no polygons or lines: give surfaces of roads, or lines along both of their edges.</source>
        <translation>レイヤにポリゴンも線もありません。道路面、または道路両側の縁の線を指定してください。</translation>
    </message>
    <message>
        <source>A road has a corner whose coordinates are no numbers or off the earth: repair the layer first.</source>
        <translation>道路に、座標が数値でない、または地球上にあり得ない頂点があります。先にレイヤを修正してください。</translation>
    </message>
    <message>
        <source>The lines enclose no surface: give the lines along both edges of the roads, joined at their ends, or surfaces.</source>
        <translation>線が面を囲んでいません。端点のつながった道路両側の縁の線、または道路面を指定してください。</translation>
    </message>
    <message>
        <source>An edge ends here without another end within {distance:.0f} m to be joined to: the road is left out, or its edge goes on in a file that was not given.</source>
        <translation>道路縁がここで終わり、{distance:.0f} m 以内に結べる端点がありません。この道路は面にならないか、縁の続きが指定されていないファイルにあります。</translation>
    </message>
    <message>
        <source>A surface crosses itself and was repaired: compare it with its source.</source>
        <translation>面が自己交差していたため修正しました。元のデータと比べて確認してください。</translation>
    </message>
    <message>
        <source>The edges around this face do not tell on which of their sides the road lies: an edge is missing, or a line is none of an edge.</source>
        <translation>この区画の周囲の縁からは、どちら側が道路か決まりません。道路縁が欠けているか、道路縁でない線が含まれています。</translation>
    </message>
    <message>
        <source>Edges cross here with {height:.1f} m between them: one road runs above another, and the surfaces here are a mixture of both. Give the edges of each road in a run of its own.</source>
        <translation>ここでは道路縁が {height:.1f} m の高低差で交差しています。道路の上を別の道路が通っていて、この付近の面は両者の混ざったものです。道路縁を道路ごとに分けて実行してください。</translation>
    </message>
    <message>
        <source>carriageway</source>
        <translation>車道部</translation>
    </message>
    <message>
        <source>sidewalk</source>
        <translation>歩道部</translation>
    </message>
    <message>
        <source>island</source>
        <translation>島</translation>
    </message>
    <message>
        <source>road, not surveyed</source>
        <translation>未計測の道路</translation>
    </message>
    <message>
        <source>continued</source>
        <translation>延長</translation>
    </message>
    <message>
        <source>official</source>
        <translation>公式データ</translation>
    </message>
    <message>
        <source>Edge {row}: “{cell}” in the field {name} is no number that can be meant; repair the layer of edges.</source>
        <translation>線 {row}: フィールド {name} の「{cell}」は値としてありえません。道路縁のレイヤーを直してください。</translation>
    </message>
    <message>
        <source>Edge {row} lies at x = {x:g}, y = {y:g}, where no map reaches; repair the layer of edges.</source>
        <translation>線 {row} の位置(x = {x:g}、y = {y:g})は地図上の位置としてありえません。道路縁のレイヤーを直してください。</translation>
    </message>
    <message>
        <source>Edge {row}: two of its corners that follow each other lie {distance:.1f} km apart, which no edge of a road does; repair the layer of edges.</source>
        <translation>線 {row} の連続する2点が {distance:.1f} km 離れており、道路縁としてありえません。道路縁のレイヤーを直してください。</translation>
    </message>
    <message>
        <source>Edge {row} lies at a height of {height:g} m, where no road is; repair the layer of edges.</source>
        <translation>線 {row} の高さが {height:g} m で、道路の高さとしてありえません。道路縁のレイヤーを直してください。</translation>
    </message>
    <message>
        <source>{layer}: shape {row} has a corner where no map reaches; repair the layer.</source>
        <translation>{layer}: 図形 {row} に地図上の位置としてありえない頂点があります。レイヤーを直してください。</translation>
    </message>
    <message>
        <source>The edges enclose no carriageway: of no road the survey shows both edges all along, and no lanes tell how far one goes. Give the drives of both directions together, or lanes.</source>
        <translation>縁が車道を囲んでいません。計測で両側の縁が続けて見える道路がなく、車道の幅を示す車線もありません。両方向の走行を一緒に与えるか、車線を指定してください。</translation>
    </message>
    <message>
        <source>The edge was not seen over {length:.1f} m and is drawn on here.</source>
        <translation>道路縁が {length:.1f} m にわたって見えず、ここでは延長しました。</translation>
    </message>
    <message>
        <source>There are no kerbs or road borders among the edges: give the lines of “Road edges”.</source>
        <translation>道路縁に縁石も路端もありません。「道路縁」の線を指定してください。</translation>
    </message>
    <message>
        <source>{length:.1f} m of this edge are doubtful ({reason}): the border is drawn along them; look at the points or the place.</source>
        <translation>この道路縁の {length:.1f} m は不確かです（{reason}）。境界はこれに沿って引いてあります。点群か現地を確認してください。</translation>
    </message>
    <message>
        <source>A short edge lies nearer than {distance:.0f} m beside a longer one: no carriageway runs between them, and it is left out.</source>
        <translation>短い縁が、より長い縁から {distance:.0f} m 以内に並んでいます。その間に車道はないため、この縁は除きました。</translation>
    </message>
    <message>
        <source>The given roads lay {distance:.2f} m beside the measured kerbs ({east:+.2f} m to the east, {north:+.2f} m to the north are put on them): their border was taken for the kerb.</source>
        <translation>与えられた道路は計測した縁石から {distance:.2f} m ずれていました（東へ {east:+.2f} m、北へ {north:+.2f} m 動かしました）。その境界を縁石とみなしています。</translation>
    </message>
    <message>
        <source>The edge on this side was not seen over {length:.0f} m: the carriageway is drawn to the outermost lane that was measured, and nothing beside it. Give the drive of the other direction, too.</source>
        <translation>こちら側の縁は {length:.0f} m にわたって見えていません。車道は計測された最も外側の車線までとし、その外側には何も作りません。反対方向の走行も指定してください。</translation>
    </message>
    <message>
        <source>Of {length:.0f} m of this edge neither the other edge nor a lane beside it was seen: no carriageway is made.</source>
        <translation>この縁の {length:.0f} m では、反対側の縁も隣の車線も見えていません。車道は作りません。</translation>
    </message>
    <message>
        <source>{uncut} of {arms} roads that meet here have neither a corner nor a stop line at which to cut: cut them by hand.</source>
        <translation>ここに集まる道路 {arms} 本のうち {uncut} 本に、区切るための隅角も停止線もありません。手作業で区切ってください。</translation>
    </message>
    <message>
        <source>{area:.0f} m² of the given roads were not surveyed: they are left undivided.</source>
        <translation>与えた道路のうち {area:.0f} m² は計測されていません。区分せずに残します。</translation>
    </message>
    <message>
        <source>The edges leave out a part of the carriageway here of which less than half of the border was measured: look whether it is an island.</source>
        <translation>ここで車道部の一部が道路縁に囲まれていますが、境界の半分以上が計測されていません。島かどうか確認してください。</translation>
    </message>
    <message>
        <source>There is no level {level}: choose one of {levels}.</source>
        <translation>詳細度 {level} はありません。{levels} から選んでください。</translation>
    </message>
    <message>
        <source>The edges have no heights, of which this level of detail is made: give the lines of “Road edges” as they were made, or choose level 2.</source>
        <translation>道路縁の線に高さがなく、この詳細度(LOD)は作成できません。「道路縁」の出力の線をそのまま指定するか、レベル2を選んでください。</translation>
    </message>
    <message>
        <source>The survey ends here; the road goes on.</source>
        <translation>計測はここで終わります。道路は続きます。</translation>
    </message>
    <message>
        <source>No surfaces of roads were given: where sidewalks end is not known, and none is made.</source>
        <translation>道路面が指定されていません。歩道部の外側の境界が分からないため、歩道部は作りません。</translation>
    </message>
    <message>
        <source>No lanes were given: carriageways are not divided.</source>
        <translation>車線が指定されていません。車道部は車線に区分しません。</translation>
    </message>
    <message>
        <source>There is no stop line in this arm: its junction is cut at the corners.</source>
        <translation>この流入路に停止線がありません。交差部は隅角で区切りました。</translation>
    </message>
    <message>
        <source>The top of this island was not measured apart from its kerb.</source>
        <translation>この島の上面は、縁石のほかは計測されていません。</translation>
    </message>
    <message>
        <source>Roads meet here, but nothing tells where to cut them.</source>
        <translation>ここで道路が交差しますが、区切る位置を示すものがありません。</translation>
    </message>
    <message>
        <source>A low edge, at most {height:.2f} m high, runs with another like a tram's track amid the carriageway: it bounds no island. Draw it as one by hand where it does.</source>
        <translation>高さ {height:.2f} m 以下の低い縁が、もう 1 本の縁と路面電車の軌道のように車道内を並走しています。島の縁とはみなしません。島であれば手で描いてください。</translation>
    </message>
    <message>
        <source>Frame {number} of {exposures_count}</source>
        <translation>空中写真 {number}/{exposures_count}</translation>
    </message>
    <message>
        <source>Line scanners</source>
        <translation>ラインスキャナ</translation>
    </message>
    <message>
        <source>Line camera</source>
        <translation>ラインカメラ</translation>
    </message>
    <message>
        <source>Mobile survey {number} of {survey_times_count}</source>
        <translation>MMS計測 {number}/{survey_times_count}</translation>
    </message>
    <message>
        <source>There is no fault {name!r}: choose among {faults}.</source>
        <translation>誤差要因{name!r}はありません。{faults}から選択してください。</translation>
    </message>
    <message>
        <source>{folder} is a file: give the name of a new folder.</source>
        <translation>{folder}はファイルです。新しいフォルダ名を指定してください。</translation>
    </message>
    <message>
        <source>The folder {folder} is not empty: give the name of a new one.</source>
        <translation>フォルダ{folder}は空ではありません。新しいフォルダ名を指定してください。</translation>
    </message>
    <message>
        <source>The folder {parent} does not exist: create it or choose another.</source>
        <translation>フォルダ{parent}がありません。作成するか、別のフォルダを選択してください。</translation>
    </message>
    <message>
        <source>The folder {parent} cannot be written: choose another.</source>
        <translation>フォルダ{parent}に書き込めません。別のフォルダを選択してください。</translation>
    </message>
    <message>
        <source>There is no scene {scene!r}: choose one of {scenes}.</source>
        <translation>シーン{scene!r}はありません。{scenes}から選択してください。</translation>
    </message>
    <message>
        <source>The size of the city must be {min_size:g} to {max_size:g} m, not {size:g}.</source>
        <translation>都市の大きさは{min_size:g}～{max_size:g} mの範囲で指定してください（{size:g}は範囲外です）。</translation>
    </message>
    <message>
        <source>{path} cannot be written: {error}</source>
        <translation>{path}に書き込めません: {error}</translation>
    </message>
    <message>
        <source>Aerial frames and orthophoto</source>
        <translation>空中写真とオルソ画像</translation>
    </message>
    <message>
        <source>Mobile surveys</source>
        <translation>MMS計測</translation>
    </message>
    <message>
        <source>Airborne laser scanning</source>
        <translation>航空レーザ測量</translation>
    </message>
    <message>
        <source>The folder {folder} cannot be written ({strerror}): choose another.</source>
        <translation>フォルダ{folder}に書き込めません（{strerror}）。別のフォルダを選択してください。</translation>
    </message>
    <message>
        <source>{label}: {value} is none of {choices}.</source>
        <translation>{label}: {value}は{choices}のいずれでもありません。</translation>
    </message>
    <message>
        <source>{label} must be greater than 0.</source>
        <translation>{label}は0より大きくなければなりません。</translation>
    </message>
    <message>
        <source>{label} must not be less than 0.</source>
        <translation>{label}は0以上でなければなりません。</translation>
    </message>
    <message>
        <source>The cloud has no point with a usable height.</source>
        <translation>点群に有効な高さを持つ点がありません。</translation>
    </message>
    <message>
        <source>The cloud has no points that could be ground.</source>
        <translation>点群に地表面となり得る点がありません。</translation>
    </message>
    <message>
        <source>Finding the highest points of the cells.</source>
        <translation>各セルの最高点を求めています。</translation>
    </message>
    <message>
        <source>Settling the cloth.</source>
        <translation>クロスを沈めています。</translation>
    </message>
    <message>
        <source>The points fill next to nothing of the box around them, and some lie near {x:.0f}, {y:.0f}, {length:.0f} km from the others: remove those, or work on the places one by one.</source>
        <translation>点群が占める範囲は全体の外接範囲に比べてごくわずかで、一部の点が {x:.0f}, {y:.0f} 付近（他の点から {length:.0f} km）にあります。その点を取り除くか、場所ごとに分けて処理してください。</translation>
    </message>
    <message>
        <source>The raster would have {columns:,} x {rows:,} cells: choose a coarser resolution, or check for points far outside the area.</source>
        <translation>ラスタが{columns:,} x {rows:,}セルになります。解像度を粗くするか、範囲から遠く離れた点がないか確認してください。</translation>
    </message>
    <message>
        <source>The area is too large for one cloth: choose a coarser cloth resolution.</source>
        <translation>範囲が1枚のクロスには広すぎます。クロスの解像度を粗くしてください。</translation>
    </message>
    <message>
        <source>A surface needs at least three points: check the input's extent.</source>
        <translation>面の作成には3点以上が必要です。入力の範囲を確認してください。</translation>
    </message>
    <message>
        <source>All points lie on one line: a surface cannot be built from them.</source>
        <translation>すべての点が一直線上にあるため、面を作成できません。</translation>
    </message>
    <message>
        <source>{undecided:,} of {total:,} points are unclassified</source>
        <translation>{total:,} 点中 {undecided:,} 点が未分類です</translation>
    </message>
    <message>
        <source>The cloud holds no usable points: all are noise or have no valid height.</source>
        <translation>点群に使用できる点がありません。すべてノイズか、有効な高さがありません。</translation>
    </message>
    <message>
        <source>The ground source must be automatic, classes or cloth, not {wanted}.</source>
        <translation>地表面の取得元はautomatic、classes、clothのいずれかにしてください（{wanted}は使用できません）。</translation>
    </message>
    <message>
        <source>The cloud has no ground points (class 2): choose the cloth filter instead.</source>
        <translation>点群に地表面の点（クラス2）がありません。クロスフィルタを選択してください。</translation>
    </message>
    <message>
        <source>{ground:,} of {total:,} points have a ground class</source>
        <translation>{total:,} 点中 {ground:,} 点に地表の分類があります</translation>
    </message>
    <message>
        <source>The cloud has no ground points, only points classified as something else (such as buildings): give the whole cloud with its ground.</source>
        <translation>点群に地表面の点がなく、他（建物など）に分類された点だけがあります。地表面を含む点群全体を指定してください。</translation>
    </message>
    <message>
        <source>No ground points were found: check that the cloud shows the ground.</source>
        <translation>地表面の点が見つかりませんでした。点群に地表面が含まれているか確認してください。</translation>
    </message>
    <message>
        <source>Triangulating the ground.</source>
        <translation>地表面の三角網を作成しています。</translation>
    </message>
    <message>
        <source>Triangulating the surface.</source>
        <translation>表層の三角網を作成しています。</translation>
    </message>
    <message>
        <source>The points lie in fewer than three places or on one line: a surface cannot be built from them.</source>
        <translation>点の位置が3か所未満か一直線上にあるため、面を作成できません。</translation>
    </message>
    <message>
        <source>Ground by {value}: {reason}.</source>
        <translation>地表面の取得元: {value}（{reason}）。</translation>
    </message>
    <message>
        <source>{left_out:,} of {triangles:,} triangles were longer than {max_edge:g} m and left out.</source>
        <translation>三角形{triangles:,}個のうち{left_out:,}個は{max_edge:g} mより長いため除外しました。</translation>
    </message>
    <message>
        <source>{far_share:.0f} % of the surface spans {far:g} m or more without points (water, gaps): set a longest edge to leave such places out.</source>
        <translation>面の{far_share:.0f} %は、点のない{far:g} m以上の区間（水面、欠測）にまたがっています。除外するには最大辺長を設定してください。</translation>
    </message>
    <message>
        <source>the cloth filter</source>
        <translation>クロスフィルタ</translation>
    </message>
    <message>
        <source>The folder of the run, {run_folder}, is not there any more or cannot be written ({strerror}): put it right and run again; tiles that are whole are kept.</source>
        <translation>実行フォルダ{run_folder}がなくなったか、書き込めません（{strerror}）。修正して再実行してください。完成したタイルは保持されます。</translation>
    </message>
    <message>
        <source>There is no room in the folder of the run, {run_folder} ({strerror}): make some and run again; tiles that are whole are kept.</source>
        <translation>実行フォルダ{run_folder}に空き容量がありません（{strerror}）。容量を確保して再実行してください。完成したタイルは保持されます。</translation>
    </message>
    <message>
        <source>{place} is a file where the run needs a folder: move it away, or choose another folder.</source>
        <translation>{place} は、処理でフォルダーが必要な場所にあるファイルです。移動するか、別のフォルダーを選んでください。</translation>
    </message>
    <message>
        <source>The folder {run_folder} cannot be written ({strerror}): choose another.</source>
        <translation>フォルダ{run_folder}に書き込めません（{strerror}）。別のフォルダを選択してください。</translation>
    </message>
    <message>
        <source>Another run works in {run_folder}: wait for its end, or choose another folder.</source>
        <translation>{run_folder}では別の処理が実行中です。終了を待つか、別のフォルダを選択してください。</translation>
    </message>
    <message>
        <source>Map sheets need a plane rectangular system of Japan, and {plan} is none: choose squares or meshes, or reproject the data.</source>
        <translation>図郭には日本の平面直角座標系が必要ですが、{plan}は該当しません。正方形またはメッシュを選択するか、データの座標系を変換してください。</translation>
    </message>
    <message>
        <source>map sheets of level {level}, plane rectangular system {system}</source>
        <translation>国土基本図図郭（地図情報レベル{level}、平面直角座標系 第{system}系）</translation>
    </message>
    <message>
        <source>The data states no coordinate reference system, which map sheets need: give it (POINTS_CRS), or choose squares.</source>
        <translation>データに図郭に必要な座標参照系の記載がありません。指定する（POINTS_CRS）か、正方形を選択してください。</translation>
    </message>
    <message>
        <source>The data leaves the area of the map sheets, 160 km east and west and 300 km north and south of the origin: choose squares or meshes.</source>
        <translation>データが図郭の範囲（原点から東西160 km、南北300 km）を超えています。正方形またはメッシュを選択するか、データの座標系を変換してください。</translation>
    </message>
    <message>
        <source>{path} cannot be written ({error}).</source>
        <translation>{path}に書き込めません（{error}）。</translation>
    </message>
    <message>
        <source>{path} of the tile {parent} has other cells than the first tile: the rasters cannot be put together.</source>
        <translation>タイル{parent}の{path}は最初のタイルとセルが異なるため、ラスタを結合できません。</translation>
    </message>
    <message>
        <source>regional meshes of about {size:g} m</source>
        <translation>約 {size:g} m の地域メッシュ</translation>
    </message>
    <message>
        <source>The data states no coordinate reference system, which meshes need: give it (POINTS_CRS), or choose squares.</source>
        <translation>データにメッシュに必要な座標参照系の記載がありません。指定する（POINTS_CRS）か、正方形を選択してください。</translation>
    </message>
    <message>
        <source>The extent of the data is not a number: check its coordinates.</source>
        <translation>データの範囲が数値ではありません。座標を確認してください。</translation>
    </message>
    <message>
        <source>The data is not in the range of Japan's meshes, 0 to 66 degrees north and 100 to 180 east: choose squares.</source>
        <translation>データが日本のメッシュの範囲（北緯0～66度、東経100～180度）にありません。正方形を選択してください。</translation>
    </message>
    <message>
        <source>The data would take more than a million meshes: choose larger ones, or check the coordinates.</source>
        <translation>データのメッシュ数が100万を超えます。より大きいメッシュを選択するか、座標を確認してください。</translation>
    </message>
    <message>
        <source>Tiles: done green, empty grey, failed red, not done white. North is up. Look for empty tiles where data should be.</source>
        <translation>タイル：完了は緑、空は灰、失敗は赤、未処理は白。上が北です。データがあるはずの所の空のタイルを探してください。</translation>
    </message>
    <message>
        <source>This is an estimate from {records_count} of {tiles_count} tiles.</source>
        <translation>{tiles_count}タイル中{records_count}タイルからの推定です。</translation>
    </message>
    <message>
        <source>{failed_count} more are in the layer of tiles.</source>
        <translation>ほかに{failed_count}件がタイルのレイヤにあります。</translation>
    </message>
    <message>
        <source>{count} of {tiles_count} tiles failed, and what lies in them is missing. Run again with the same folder when the reasons below are put right: only the failed tiles are then done.</source>
        <translation>{tiles_count} タイル中 {count} タイルが失敗し、その範囲の結果がありません。下の理由を解消してから同じフォルダで再実行してください。失敗したタイルだけが処理されます。</translation>
    </message>
    <message>
        <source>All {tiles_count} tiles are done.</source>
        <translation>全{tiles_count}タイルが完了しました。</translation>
    </message>
    <message>
        <source>{total} walls: {good} ok, {doubtful} doubtful.</source>
        <translation>壁 {total} 面：良好 {good}、要確認 {doubtful}。</translation>
    </message>
    <message>
        <source>{total} buildings: {good} ok, {doubtful} doubtful, {missing} failed.</source>
        <translation>建物 {total} 棟：良好 {good}、要確認 {doubtful}、失敗 {missing}。</translation>
    </message>
    <message>
        <source>The field “status” of the merged layer tells which and why.</source>
        <translation>どれがなぜそうなのかは、結合レイヤのフィールド「status」に示します。</translation>
    </message>
    <message>
        <source>stretches of {size:g} m of the drive</source>
        <translation>走行の {size:g} m ごとの区間</translation>
    </message>
    <message>
        <source>The points have no GPS time, by which a survey is cut into stretches: give a point cloud with times.</source>
        <translation>点にGPS時刻がありません。計測の区間分割に必要です。時刻付きの点群を指定してください。</translation>
    </message>
    <message>
        <source>The drive would take more than a million stretches: give longer ones.</source>
        <translation>走行の区間数が100万を超えます。区間を長くしてください。</translation>
    </message>
    <message>
        <source>squares of {size:g} m</source>
        <translation>一辺 {size:g} m の正方形</translation>
    </message>
    <message>
        <source>The side of a tile must be a whole number of metres, and its buffer not negative: change them.</source>
        <translation>タイルの辺長は整数のメートル、バッファは0以上にしてください。</translation>
    </message>
    <message>
        <source>The data would take {count:,} tiles of {size:g} m: give larger tiles, or check the coordinates.</source>
        <translation>データは{size:g} mのタイルで{count:,}枚になります。タイルを大きくするか、座標を確認してください。</translation>
    </message>
    <message>
        <source>Shifted by {0:.3f} m east, {1:.3f} m north, {2:.3f} m up.</source>
        <translation>東へ {0:.3f} m、北へ {1:.3f} m、上へ {2:.3f} m 移動しました。</translation>
    </message>
    <message>
        <source>{0} control points: {1:.3f} m off in plan as given, {2:.3f} m after (RMS).</source>
        <translation>標定点 {0} 点：水平のずれは入力のまま {1:.3f} m、調整後 {2:.3f} m（RMS）。</translation>
    </message>
    <message>
        <source>Each control point left out in turn: {0:.3f} m.</source>
        <translation>標定点を1つずつ除いた場合：{0:.3f} m。</translation>
    </message>
    <message>
        <source>{0}: no raster can be opened; check the files.</source>
        <translation>{0}: ラスタを開けません。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{0} has no field {1}; give the points of “Orthorectify frames”.</source>
        <translation>{0}にフィールド{1}がありません。「写真のオルソ補正」の点を指定してください。</translation>
    </message>
    <message>
        <source>{0} has no height at {1} of {2} markings: they lie outside of it or in its gaps, and have no height there.</source>
        <translation>{0}には標示{2}件中{1}件の位置で高さがありません。範囲外または欠測のため、その標示には高さがありません。</translation>
    </message>
    <message>
        <source>{0}: {1} x {2} pixels</source>
        <translation>{0}: {1} x {2} 画素</translation>
    </message>
    <message>
        <source>In {0} outlines the surface shows no building.</source>
        <translation>{0}件の外周線では、表層モデルに建物が現れていません。</translation>
    </message>
    <message>
        <source>{0} frames used; {1:.1f} % of the ground outside buildings seen, {2:.0f} m2 in holes.</source>
        <translation>空中写真{0}枚を使用。建物以外の地表の{1:.1f} %が見えており、欠落は{2:.0f} m2です。</translation>
    </message>
    <message>
        <source>{0}: {1} are given for {2} frames; give one for each frame, in the same order.</source>
        <translation>{0}: 空中写真{2}枚に対して{1}件が指定されています。写真ごとに1件ずつ、同じ順で指定してください。</translation>
    </message>
    <message>
        <source>{0} has no field {1}; choose another.</source>
        <translation>{0}にフィールド{1}がありません。別のフィールドを選択してください。</translation>
    </message>
    <message>
        <source>The field {0} of {1} must hold numbers: heights above the ground in metres.</source>
        <translation>{1}のフィールド{0}は数値（地上高、メートル）にしてください。</translation>
    </message>
    <message>
        <source>{0} is no longer used: nothing is learned from answers. Raise or lower MIN_CONFIDENCE, and delete from the markings what is no paint.</source>
        <translation>{0}はもう使われません（回答からの学習は行いません）。MIN_CONFIDENCEを上げ下げし、標示でないものはレイヤから削除してください。</translation>
    </message>
    <message>
        <source>Nothing of the orthophoto is left to look at: check that roads, buildings and hidden areas lie where the image does; the mask is empty.</source>
        <translation>オルソ画像に対象となる範囲が残っていません。道路、建物、遮蔽範囲が画像と同じ場所にあるか確認してください。マスクは空です。</translation>
    </message>
    <message>
        <source>No markings were found: the mask is empty; check the roads, or lower the contrast.</source>
        <translation>路面標示が見つかりませんでした。マスクは空です。道路を確認するか、コントラストを下げてください。</translation>
    </message>
    <message>
        <source>{0}: the coordinate reference system is missing; assign the one that the image is in (Layer &gt; Set CRS).</source>
        <translation>{0}: 座標参照系がありません。画像の座標参照系を設定してください（レイヤ &gt; レイヤのCRSを設定）。</translation>
    </message>
    <message>
        <source>{0}: its pixels are measured in degrees; warp it to a projected CRS, such as the local plane rectangular or UTM zone.</source>
        <translation>{0}: 画素が度単位です。平面直角座標系やUTMなどの投影座標参照系に変換（再投影）してください。</translation>
    </message>
    <message>
        <source>{0}: there are no polygons; check the layer and its filter, or leave it out.</source>
        <translation>{0}: ポリゴンがありません。レイヤとフィルタを確認するか、指定を外してください。</translation>
    </message>
    <message>
        <source>With pixels of {0:.2f} m only wide markings can be seen; 0.15 m or finer shows lane lines.</source>
        <translation>画素が{0:.2f} mでは幅の広い標示しか判別できません。車線境界線には0.15 m以下が必要です。</translation>
    </message>
    <message>
        <source>{0} of {1} buildings have no model; the field “reason” says why.</source>
        <translation>建物{1}棟中{0}棟にモデルがありません。理由はフィールド「reason」を参照してください。</translation>
    </message>
    <message>
        <source>{0} of {1} buildings ({2} %) have no ground under them: their bases are taken from neighbours or assumed; give a ground elevation or a field with the base height.</source>
        <translation>建物{1}棟中{0}棟（{2} %）は下に地表面がなく、底面は近隣の値または仮定値です。地表面の標高または基準高のフィールドを指定してください。</translation>
    </message>
    <message>
        <source>{0} of {1} models have a flaw; the fields “status” and “reason” say which.</source>
        <translation>モデル{1}件中{0}件に不備があります。内容はフィールド「status」と「reason」を参照してください。</translation>
    </message>
    <message>
        <source>{0}: the field {1} is missing or has empty values; give the result of “Roof polygons”.</source>
        <translation>{0}: フィールド{1}がないか、空の値があります。「屋根ポリゴン」の結果を指定してください。</translation>
    </message>
    <message>
        <source>{0} buildings; {1} outlines of what may be no building; {2} groups of points are smaller than {3} m2, {4} look like crowns.</source>
        <translation>建物 {0} 棟、建物でない可能性のある外周線 {1} 件。{3} m2 未満の点の集まりが {2} 件、樹冠とみられるものが {4} 件あります。</translation>
    </message>
    <message>
        <source>{0}: this system's GDAL cannot write GeoParquet; give a name that ends in .gpkg.</source>
        <translation>{0}: このシステムのGDALはGeoParquetを書き出せません。.gpkgで終わる名前を指定してください。</translation>
    </message>
    <message>
        <source>Give point clouds, a raster or a layer, one of them, and the output of that kind.</source>
        <translation>点群、ラスタ、レイヤのいずれか1つと、同じ種類の出力を指定してください。</translation>
    </message>
    <message>
        <source>Give a grid, or one value in its place.</source>
        <translation>グリッドか、その代わりの1つの値を指定してください。</translation>
    </message>
    <message>
        <source>{0} heights changed by {1:+.3f} to {2:+.3f} m, {3:+.3f} m in the mean, into {4}</source>
        <translation>{0}: 高さの変化は{1:+.3f}～{2:+.3f} m、平均{3:+.3f} m、変換先: {4}</translation>
    </message>
    <message>
        <source>{0}: no feature has heights (z); there is nothing to convert.</source>
        <translation>{0}: 高さ（z）を持つ地物がなく、変換対象がありません。</translation>
    </message>
    <message>
        <source>{0}: the fields {1} hold heights of before; compute them anew.</source>
        <translation>{0}: フィールド{1}は変換前の高さのままです。再計算してください。</translation>
    </message>
    <message>
        <source>No output is asked for; choose one.</source>
        <translation>出力が指定されていません。いずれかを選択してください。</translation>
    </message>
    <message>
        <source>A city model is written to other files only; for a layer use “Load city model”.</source>
        <translation>都市モデルは他のファイルにのみ書き出せます。レイヤにするには「都市モデルの読込」を使用してください。</translation>
    </message>
    <message>
        <source>Give either {0} or {1}.</source>
        <translation>{0}または{1}のどちらかを指定してください。</translation>
    </message>
    <message>
        <source>{0}: there is no field {1}; choose one of the layer.</source>
        <translation>{0}: フィールド{1}がありません。レイヤのフィールドを選択してください。</translation>
    </message>
    <message>
        <source>{0}: the field surface_type is missing; give the surfaces of “Building models”.</source>
        <translation>{0}: フィールドsurface_typeがありません。「建物モデル」の面を指定してください。</translation>
    </message>
    <message>
        <source>{0}: no feature has faces with heights; give building models (MultiPolygonZ), such as those of “Building models”.</source>
        <translation>{0}: 高さ付きの面を持つ地物がありません。「建物モデル」の結果などの建物モデル（MultiPolygonZ）を指定してください。</translation>
    </message>
    <message>
        <source>{0} of {1} buildings have no model and are written without a shape.</source>
        <translation>建物{1}棟中{0}棟にモデルがなく、形状なしで書き出されます。</translation>
    </message>
    <message>
        <source>{0} of {1} ids were empty or there more than once; they got a number.</source>
        <translation>id {1}件中{0}件が空または重複していたため、番号を付けました。</translation>
    </message>
    <message>
        <source>{0} of {1} buildings have a solid that is not closed or not valid; it is written as surfaces, and the field “problems” says why.</source>
        <translation>建物{1}棟中{0}棟の立体が閉じていないか不正です。面として書き出されます。理由はフィールド「problems」を参照してください。</translation>
    </message>
    <message>
        <source>{0} images of textures are missing ({1}); their faces have none.</source>
        <translation>テクスチャ画像{0}枚がありません（{1}）。該当する面にはテクスチャがありません。</translation>
    </message>
    <message>
        <source>No face of {0} has a texture in {1}; check that both are of the same buildings.</source>
        <translation>{0}の面のテクスチャが{1}に1つもありません。両者が同じ建物のものか確認してください。</translation>
    </message>
    <message>
        <source>{0} is not written from a city model; for a layer use “Load city model”.</source>
        <translation>都市モデルから{0}は書き出されません。レイヤにするには「都市モデルの読込」を使用してください。</translation>
    </message>
    <message>
        <source>No file was given: choose a city model (.gml, .json, .jsonl, .zip) or a folder.</source>
        <translation>ファイルが指定されていません。都市モデル（.gml, .json, .jsonl, .zip）またはフォルダを選択してください。</translation>
    </message>
    <message>
        <source>The files hold roads or street objects and no building: the layer of buildings is empty.</source>
        <translation>ファイルには道路か道路沿いの地物があり、建物はありません。建物のレイヤは空です。</translation>
    </message>
    <message>
        <source>{0} buildings in {1}, heights: {2}</source>
        <translation>建物{0}棟、{1}、高さ: {2}</translation>
    </message>
    <message>
        <source>{0}: {1} is not known; choose another.</source>
        <translation>{0}: {1}は不明です。別のものを選択してください。</translation>
    </message>
    <message>
        <source>{0} of {1} buildings have something wrong; the field “note” says what.</source>
        <translation>建物{1}棟中{0}棟に不備があります。内容はフィールド「note」を参照してください。</translation>
    </message>
    <message>
        <source>{0} values stand for “unknown” ({1}): their fields are empty, a height is top less ground.</source>
        <translation>「不明」を表す値が{0}個あります（{1}）。これらの属性は空とし、高さは上端と地盤の高さの差とします。</translation>
    </message>
    <message>
        <source>No file was given: choose building outlines or elevation models of the GSI (.xml, .zip) or a folder.</source>
        <translation>ファイルが指定されていません。国土地理院の建築物の外周線または数値標高モデル（.xml, .zip）かフォルダを選択してください。</translation>
    </message>
    <message>
        <source>{0} buildings, {1}</source>
        <translation>建物{0}棟、{1}</translation>
    </message>
    <message>
        <source>{0} meshes ({1}), heights in {2}, {3:.1f} to {4:.1f} m, {5:.1f} % of the cells empty</source>
        <translation>{0}メッシュ（{1}）、高さの基準{2}、{3:.1f}～{4:.1f} m、空のセル{5:.1f} %</translation>
    </message>
    <message>
        <source>The elevation model was taken into {0} by {1}.</source>
        <translation>標高モデルは{1}により{0}に変換されました。</translation>
    </message>
    <message>
        <source>Give the building models either as a layer or as a CityJSON file.</source>
        <translation>建物モデルはレイヤかCityJSONファイルのどちらかで指定してください。</translation>
    </message>
    <message>
        <source>{0}: the walls have no field status, which tells how well each was measured; give the result of “Walls from a mobile survey”.</source>
        <translation>{0}: 壁面に計測の良否を示すフィールドstatusがありません。「MMS計測の壁面」の結果を指定してください。</translation>
    </message>
    <message>
        <source>{0} of {1} buildings could not be merged and keep their models; the field “reason” tells why.</source>
        <translation>建物{1}棟中{0}棟は統合できず、元のモデルのままです。理由はフィールド「reason」を参照してください。</translation>
    </message>
    <message>
        <source>{0} walls are no upright faces and are left out.</source>
        <translation>壁面{0}件は鉛直な面でないため除外しました。</translation>
    </message>
    <message>
        <source>{0}: the walls have no heights; give the result of “Walls from a mobile survey”.</source>
        <translation>{0}: 壁面に高さがありません。「MMS計測の壁面」の結果を指定してください。</translation>
    </message>
    <message>
        <source>{0} are made of points: give “{1}”, or leave them out.</source>
        <translation>{0}は点群から作られます。「{1}」を指定するか、これを指定しないでください。</translation>
    </message>
    <message>
        <source>{0} of {1} buildings have no mesh; the field “reason” tells why.</source>
        <translation>建物{1}棟中{0}棟にメッシュがありません。理由はフィールド「reason」を参照してください。</translation>
    </message>
    <message>
        <source>{0} of {1} meshes have fewer than 95 % of their uppermost points within the stated error; the field “within” tells how many.</source>
        <translation>メッシュ{1}件中{0}件で、指定誤差内の最上部の点が95 %未満です。点の割合はフィールド「within」を参照してください。</translation>
    </message>
    <message>
        <source>{0} of {1} buildings got no roof polygon.</source>
        <translation>建物{1}棟中{0}棟に屋根ポリゴンがありません。</translation>
    </message>
    <message>
        <source>Flown {0} to {1}: {2} of {3} outlines are dated after it ({4} of them have no points), {5} had ended before it.</source>
        <translation>計測日 {0} ～ {1}：{3} 件の外周線のうち {2} 件はそれより後の日付（うち点なし {4} 件）、{5} 件はそれより前に消滅しています。</translation>
    </message>
    <message>
        <source>{0} of {1} buildings have too few points for a model.</source>
        <translation>建物{1}棟中{0}棟は点が少なすぎてモデルを作成できません。</translation>
    </message>
    <message>
        <source>{0} is {1} m, more than {2}, {3} m: heights between the bins would be lost; give at most the width.</source>
        <translation>{0}は{1} mで、{2}の{3} mを超えています。階級間の高さが失われるため、幅以下の値を指定してください。</translation>
    </message>
    <message>
        <source>{0} of {1} buildings have no roof in their points.</source>
        <translation>建物{1}棟中{0}棟は点群に屋根がありません。</translation>
    </message>
    <message>
        <source>{0} new, {1} gone, {2} changed, {3} the same, {4} not seen.</source>
        <translation>新築 {0}、滅失 {1}、変化あり {2}、変化なし {3}、未観測 {4}。</translation>
    </message>
    <message>
        <source>Building {0} changed, but no new model can be made: {1}</source>
        <translation>建物 {0} は変化しましたが、新しいモデルを作成できません：{1}</translation>
    </message>
    <message>
        <source>No wall was found: the survey shows too little of the buildings, or does not lie on the map.</source>
        <translation>壁面が見つかりませんでした。計測に建物がほとんど写っていないか、地図と位置が合っていません。</translation>
    </message>
    <message>
        <source>The buildings tell no heights: coverage is counted up to the highest point seen of each wall.</source>
        <translation>建物に高さの情報がありません。被覆率は各壁面の計測された最高点までで算出します。</translation>
    </message>
    <message>
        <source>{0} of {1} buildings near the survey show no wall.</source>
        <translation>計測範囲付近の建物{1}棟中{0}棟に壁面がありません。</translation>
    </message>
    <message>
        <source>Correction in plan (m)</source>
        <translation>水平補正量 (m)</translation>
    </message>
    <message>
        <source>Standard deviation in plan (m)</source>
        <translation>水平位置の標準偏差 (m)</translation>
    </message>
    <message>
        <source>Residual of the windows (m)</source>
        <translation>ウィンドウの残差 (m)</translation>
    </message>
    <message>
        <source>Give check points, or building models whose edges are to be surveyed.</source>
        <translation>検証点か、点検測量する辺を抽出する建物モデルを指定してください。</translation>
    </message>
    <message>
        <source>Map level: “given” needs a limit in plan or in height; give one of them.</source>
        <translation>地図情報レベル: givenの場合は、水平位置または標高の制限値を指定してください。</translation>
    </message>
    <message>
        <source>{0} has no field {1}: give the patches of “Register mobile survey”.</source>
        <translation>{0}にフィールド{1}がありません。「MMS計測の位置合わせ」のパッチを指定してください。</translation>
    </message>
    <message>
        <source>{0} is no layout for this report: change a copy of the plugin's own, and keep the ids of its items ({1}).</source>
        <translation>{0}はこの報告書のレイアウトではありません。プラグインのレイアウトの複製を変更し、アイテムのID（{1}）は残してください。</translation>
    </message>
    <message>
        <source>Check of a lane map</source>
        <translation>車線地図の検査</translation>
    </message>
    <message>
        <source>Faults by rule</source>
        <translation>規則別の不備</translation>
    </message>
    <message>
        <source>No file was given: choose a city model (.gml, .zip), a folder of them, or a lane map (.osm).</source>
        <translation>ファイルが指定されていません。3D都市モデル（.gml、.zip）、そのフォルダ、または車線地図（.osm）を選んでください。</translation>
    </message>
    <message>
        <source>{0} lanelets, {1} errors, {2} warnings.</source>
        <translation>レーンレット {0}、エラー {1}、警告 {2}。</translation>
    </message>
    <message>
        <source>Put the errors right first: with them programs refuse the map or lead the wrong way.</source>
        <translation>まずエラーを直してください。エラーがあると、プログラムが地図を拒否するか誤った経路を示します。</translation>
    </message>
    <message>
        <source>Severity</source>
        <translation>重大度</translation>
    </message>
    <message>
        <source>Rule</source>
        <translation>規則</translation>
    </message>
    <message>
        <source>The map can be loaded; look at the warnings before routes rely on it.</source>
        <translation>地図は読み込めます。経路に使う前に警告を確認してください。</translation>
    </message>
    <message>
        <source>Element</source>
        <translation>要素</translation>
    </message>
    <message>
        <source>{0}: a lane map is checked by itself, and has no tables of files and features: leave the folder and these outputs out.</source>
        <translation>{0}：車線地図は単独で検査し、ファイルや地物の表はありません。フォルダとこれらの出力を指定しないでください。</translation>
    </message>
    <message>
        <source>{0}: the file holds no lanelets (relations of type lanelet); give a Lanelet2 map.</source>
        <translation>{0}: ファイルにlanelet（タイプlaneletのrelation）がありません。Lanelet2地図を指定してください。</translation>
    </message>
    <message>
        <source>{0}: the rules are those of CityGML; write {1} as CityGML by “Export city model” first.</source>
        <translation>{0}: 規則は CityGML のものです。先に「3D都市モデルの書き出し」で {1} を CityGML にしてください。</translation>
    </message>
    <message>
        <source>The first 500 of {0} are shown; the layer holds all.</source>
        <translation>{0}件のうち最初の500件を表示しています。レイヤにはすべて含まれます。</translation>
    </message>
    <message>
        <source>as reported</source>
        <translation>補正前</translation>
    </message>
    <message>
        <source>A corrected trajectory is compared with the reported one: give this too.</source>
        <translation>補正後の軌跡は計測時の軌跡と比較します。計測時の軌跡も指定してください。</translation>
    </message>
    <message>
        <source>A trajectory is judged by control points: give these as check points.</source>
        <translation>軌跡は検証点で判定します。検証点を指定してください。</translation>
    </message>
    <message>
        <source>corrected</source>
        <translation>補正後</translation>
    </message>
    <message>
        <source>{0}: residuals are of control points in a survey: give its trajectory, or leave them out.</source>
        <translation>{0}：残差は計測データ中の検証点について求めます。その軌跡を指定するか、これを指定しないでください。</translation>
    </message>
    <message>
        <source>{0} control points were not measured during this survey: they are left out.</source>
        <translation>検証点 {0} 点はこの計測の時間外のため除外します。</translation>
    </message>
    <message>
        <source>Laser points are compared with edges of building models: give these too.</source>
        <translation>レーザ点群は建物モデルの辺と比べます。建物モデルも指定してください。</translation>
    </message>
    <message>
        <source>Give check points or laser points, not both: each is a report of its own.</source>
        <translation>検証点かレーザ点群のどちらか一方を指定してください。報告書は別々になります。</translation>
    </message>
    <message>
        <source>Edges to be surveyed are drawn from building models: give these too, or leave the table of edges out.</source>
        <translation>点検測量する辺は建物モデルから抽出します。建物モデルも指定するか、辺の表の出力を外してください。</translation>
    </message>
    <message>
        <source>Without check points there are no errors to list: leave “All points” out; the drawn edges are written as “Edges to be surveyed”.</source>
        <translation>検証点がないため、一覧にする較差がありません。「全点」の出力を外してください。抽出した辺は「点検測量する辺」に出力します。</translation>
    </message>
    <message>
        <source>Patches of a registration stand in a report on check points: give these too, or leave the patches out.</source>
        <translation>位置合わせのパッチは検証点の報告書に載せるものです。検証点も指定するか、パッチを外してください。</translation>
    </message>
    <message>
        <source>{0}: no file was given; give one or several LAS or LAZ files.</source>
        <translation>{0}: ファイルが指定されていません。LASまたはLAZファイルを1つ以上指定してください。</translation>
    </message>
    <message>
        <source>{0}: {1} does not exist; check its name.</source>
        <translation>{0}: {1}がありません。名前を確認してください。</translation>
    </message>
    <message>
        <source>{0}: {1} cannot be opened as a raster; check the file.</source>
        <translation>{0}: {1}をラスタとして開けません。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{0}: {1} is no file; export the layer to a GeoTIFF first.</source>
        <translation>{0}: {1}はファイルではありません。先にレイヤをGeoTIFFに書き出してください。</translation>
    </message>
    <message>
        <source>Step: {0}</source>
        <translation>手順: {0}</translation>
    </message>
    <message>
        <source>{0}: {1} cannot be opened as a vector layer; check the file and the layer name.</source>
        <translation>{0}: {1}をベクタレイヤとして開けません。ファイルとレイヤ名を確認してください。</translation>
    </message>
    <message>
        <source>{0}: {1} is a folder; give the LAS, LAZ or COPC files in it.</source>
        <translation>{0}: {1} はフォルダーです。その中の LAS、LAZ または COPC ファイルを指定してください。</translation>
    </message>
    <message>
        <source>{0}: the file {1} does not exist; check its name.</source>
        <translation>{0}: ファイル{1}がありません。名前を確認してください。</translation>
    </message>
    <message>
        <source>{0}: {1} is no LAS, LAZ or COPC file; convert it first.</source>
        <translation>{0}: {1}はLAS、LAZ、COPCファイルではありません。先に変換してください。</translation>
    </message>
    <message>
        <source>{0}: the name {1} must end in .laz or .las.</source>
        <translation>{0}: 名前{1}は.lazまたは.lasで終わるように指定してください。</translation>
    </message>
    <message>
        <source>{0}: {1} files do not hold closed bodies, as upright faces are lost in them; choose a GeoPackage (.gpkg).</source>
        <translation>{0}：{1} 形式では垂直な面が失われるため、閉じた立体を保存できません。GeoPackage（.gpkg）を選んでください。</translation>
    </message>
    <message>
        <source>{0}: choose a folder; a temporary one is gone when QGIS ends.</source>
        <translation>{0}：フォルダを選んでください。一時フォルダは QGIS の終了時に消えます。</translation>
    </message>
    <message>
        <source>{0} would take the place of {1} ({2}); choose another output.</source>
        <translation>{0}が{1}（{2}）を上書きします。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>{0}: {1} is one of the images in {2}; choose another output.</source>
        <translation>{0}: {1}は{2}の画像の1つです。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>{0} and {1} have the same name, {2}; give each its own.</source>
        <translation>{0}と{1}の名前が同じ{2}です。それぞれ別の名前を付けてください。</translation>
    </message>
    <message>
        <source>Add files…</source>
        <translation>ファイルを追加…</translation>
    </message>
    <message>
        <source>{0} files</source>
        <translation>{0}ファイル</translation>
    </message>
    <message>
        <source>Unknown parameter {0} is ignored; {1}</source>
        <translation>不明なパラメータ{0}は無視します。{1}</translation>
    </message>
    <message>
        <source>{0}: {1} is none of {2}; give one of these words, or its number from 0 on.</source>
        <translation>{0}: {1}は{2}のいずれでもありません。これらの語のいずれか、または0から始まる番号を指定してください。</translation>
    </message>
    <message>
        <source>{0}: {1} is no day; give it as 2026-04-01.</source>
        <translation>{0}：{1} は日付ではありません。2026-04-01 のように指定してください。</translation>
    </message>
    <message>
        <source>{0} is an id of earlier versions: “{1}” ({2}) does this now; give that.</source>
        <translation>{0}は以前の版のidです。現在は「{1}」（{2}）が行います。今後はこれを指定してください。</translation>
    </message>
    <message>
        <source>{0}: “{1}” was retired; the run takes “{2}” instead: give that.</source>
        <translation>{0}：「{1}」は廃止されました。代わりに「{2}」で実行します。今後はこれを指定してください。</translation>
    </message>
    <message>
        <source>UrbanMap job (*.urbanmap.json)</source>
        <translation>UrbanMapの作業 (*.urbanmap.json)</translation>
    </message>
    <message>
        <source>UrbanMap</source>
        <translation>UrbanMap</translation>
    </message>
    <message>
        <source>Choose…</source>
        <translation>選択…</translation>
    </message>
    <message>
        <source>Missing:</source>
        <translation>不足しているもの：</translation>
    </message>
    <message>
        <source>Nothing is missing.</source>
        <translation>不足はありません。</translation>
    </message>
    <message>
        <source>Open job…</source>
        <translation>作業を開く…</translation>
    </message>
    <message>
        <source>Save job as…</source>
        <translation>名前を付けて作業を保存…</translation>
    </message>
    <message>
        <source>1. What have you?</source>
        <translation>1. 手元のデータ</translation>
    </message>
    <message>
        <source>2. What do you want?</source>
        <translation>2. 作りたいもの</translation>
    </message>
    <message>
        <source>New job</source>
        <translation>新しい作業</translation>
    </message>
    <message>
        <source>Import table…</source>
        <translation>表の取り込み…</translation>
    </message>
    <message>
        <source>Job: {0}</source>
        <translation>作業：{0}</translation>
    </message>
    <message>
        <source>{0} was changed by another window of QGIS and is not written over: open it again, or save this job under another name.</source>
        <translation>{0}は別のQGISで変更されたため、上書きしません。開き直すか、別の名前で保存してください。</translation>
    </message>
    <message>
        <source>Map of the files' extents</source>
        <translation>ファイルの範囲の図</translation>
    </message>
    <message>
        <source>No file with a place yet</source>
        <translation>位置のあるファイルはまだありません</translation>
    </message>
    <message>
        <source>Drop files and folders here.</source>
        <translation>ここにファイルやフォルダをドロップしてください。</translation>
    </message>
    <message>
        <source>Add folder…</source>
        <translation>フォルダを追加…</translation>
    </message>
    <message>
        <source>Used as</source>
        <translation>用途</translation>
    </message>
    <message>
        <source>Reference system</source>
        <translation>座標系</translation>
    </message>
    <message>
        <source>Heights</source>
        <translation>高さ</translation>
    </message>
    <message>
        <source>Times</source>
        <translation>時刻</translation>
    </message>
    <message>
        <source>Preview of columns…</source>
        <translation>列を確認して取り込む…</translation>
    </message>
    <message>
        <source>Clear</source>
        <translation>クリア</translation>
    </message>
    <message>
        <source>Use the chosen file as</source>
        <translation>選択したファイルの用途</translation>
    </message>
    <message>
        <source>Cannot be used</source>
        <translation>使用不可</translation>
    </message>
    <message>
        <source>Does not fit together:</source>
        <translation>整合しないもの：</translation>
    </message>
    <message>
        <source>Cannot be used:</source>
        <translation>使用できないファイル：</translation>
    </message>
    <message>
        <source>as recognised</source>
        <translation>判別のとおり</translation>
    </message>
    <message>
        <source>As far as the files say, all fits together.</source>
        <translation>ファイルから分かる範囲では、すべて整合しています。</translation>
    </message>
    <message>
        <source>{0} of {1} files and layers can be used. Untick what is not to be used; where a file is used as something else than it is, choose it and say so below the table.</source>
        <translation>{1}個のファイルとレイヤのうち{0}個を使えます。使わないものはチェックを外してください。判別と違う用途に使うときは、選択して表の下で指定してください。</translation>
    </message>
    <message>
        <source>and {0} more</source>
        <translation>ほか{0}件</translation>
    </message>
    <message>
        <source>Use as: {0}</source>
        <translation>用途：{0}</translation>
    </message>
    <message>
        <source>Geoid models (*.tif *.gtx *.asc *.isg *.txt *.ver);;All files (*)</source>
        <translation>ジオイドモデル (*.tif *.gtx *.asc *.isg *.txt *.ver);;すべてのファイル (*)</translation>
    </message>
    <message>
        <source>the ellipsoid, as GNSS measures</source>
        <translation>楕円体（GNSSの測定値のまま）</translation>
    </message>
    <message>
        <source>sea level (the geoid)</source>
        <translation>標高（ジオイド）</translation>
    </message>
    <message>
        <source>true north</source>
        <translation>真北</translation>
    </message>
    <message>
        <source>grid north</source>
        <translation>座標北</translation>
    </message>
    <message>
        <source>degrees clockwise from north</source>
        <translation>度、北から時計回り</translation>
    </message>
    <message>
        <source>radians clockwise from north</source>
        <translation>ラジアン、北から時計回り</translation>
    </message>
    <message>
        <source>Control points of a survey</source>
        <translation>MMS計測の調整点・検証点</translation>
    </message>
    <message>
        <source>time</source>
        <translation>時刻</translation>
    </message>
    <message>
        <source>name</source>
        <translation>名称</translation>
    </message>
    <message>
        <source>set</source>
        <translation>組</translation>
    </message>
    <message>
        <source>column</source>
        <translation>列</translation>
    </message>
    <message>
        <source>row</source>
        <translation>行</translation>
    </message>
    <message>
        <source>role</source>
        <translation>役割</translation>
    </message>
    <message>
        <source>measured east</source>
        <translation>計測 東</translation>
    </message>
    <message>
        <source>measured north</source>
        <translation>計測 北</translation>
    </message>
    <message>
        <source>measured height</source>
        <translation>計測 高さ</translation>
    </message>
    <message>
        <source>east in the cloud</source>
        <translation>点群での東</translation>
    </message>
    <message>
        <source>north in the cloud</source>
        <translation>点群での北</translation>
    </message>
    <message>
        <source>height in the cloud</source>
        <translation>点群での高さ</translation>
    </message>
    <message>
        <source>reference east</source>
        <translation>基準 東</translation>
    </message>
    <message>
        <source>reference north</source>
        <translation>基準 北</translation>
    </message>
    <message>
        <source>latitude</source>
        <translation>緯度</translation>
    </message>
    <message>
        <source>longitude</source>
        <translation>経度</translation>
    </message>
    <message>
        <source>latitude, minutes</source>
        <translation>緯度（分）</translation>
    </message>
    <message>
        <source>latitude, seconds</source>
        <translation>緯度（秒）</translation>
    </message>
    <message>
        <source>longitude, minutes</source>
        <translation>経度（分）</translation>
    </message>
    <message>
        <source>longitude, seconds</source>
        <translation>経度（秒）</translation>
    </message>
    <message>
        <source>Tab</source>
        <translation>タブ</translation>
    </message>
    <message>
        <source>Space</source>
        <translation>空白</translation>
    </message>
    <message>
        <source>Import a table</source>
        <translation>表の取り込み</translation>
    </message>
    <message>
        <source>none: heights stay above the ellipsoid</source>
        <translation>なし（楕円体高のまま）</translation>
    </message>
    <message>
        <source>not kept</source>
        <translation>保存しない</translation>
    </message>
    <message>
        <source>as guessed</source>
        <translation>自動判定</translation>
    </message>
    <message>
        <source>Make it a</source>
        <translation>取り込む種類</translation>
    </message>
    <message>
        <source>Read as</source>
        <translation>読み込み方</translation>
    </message>
    <message>
        <source>Encoding</source>
        <translation>文字コード</translation>
    </message>
    <message>
        <source>Delimiter</source>
        <translation>区切り文字</translation>
    </message>
    <message>
        <source>Lines before the names</source>
        <translation>列名より前の行数</translation>
    </message>
    <message>
        <source>Unit of lengths</source>
        <translation>長さの単位</translation>
    </message>
    <message>
        <source>Angles</source>
        <translation>角度</translation>
    </message>
    <message>
        <source>Plane reference system</source>
        <translation>平面座標系</translation>
    </message>
    <message>
        <source>Angles count from</source>
        <translation>方位角の基準</translation>
    </message>
    <message>
        <source>Heights count from</source>
        <translation>高さの基準</translation>
    </message>
    <message>
        <source>Keep this way of reading as</source>
        <translation>この読み込み方の保存名</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>保存…</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>閉じる</translation>
    </message>
    <message>
        <source>Choose above each column what it is.</source>
        <translation>各列の上で内容を選んでください。</translation>
    </message>
    <message>
        <source>First place in {0}: {1:.3f} m east, {2:.3f} m north.</source>
        <translation>{0} での最初の位置：東 {1:.3f} m、北 {2:.3f} m。</translation>
    </message>
    <message>
        <source>First place: {0:.3f} m east, {1:.3f} m north.</source>
        <translation>最初の点：東 {0:.3f} m、北 {1:.3f} m。</translation>
    </message>
    <message>
        <source>Written: {0}</source>
        <translation>書き込みました：{0}</translation>
    </message>
    <message>
        <source>All steps are done.</source>
        <translation>すべての手順が完了しました。</translation>
    </message>
    <message>
        <source>Stopped.</source>
        <translation>中止しました。</translation>
    </message>
    <message>
        <source>It ended without a reason.</source>
        <translation>理由が示されずに終了しました。</translation>
    </message>
    <message>
        <source>Step “{0}” ({1}) failed: {2}</source>
        <translation>手順「{0}」（{1}）が失敗しました：{2}</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>実行</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>キャンセル</translation>
    </message>
    <message>
        <source>Settings…</source>
        <translation>設定…</translation>
    </message>
    <message>
        <source>running</source>
        <translation>実行中</translation>
    </message>
    <message>
        <source>{0} of {1}: {2}</source>
        <translation>{0}/{1}：{2}</translation>
    </message>
    <message>
        <source>{0} s</source>
        <translation>{0} 秒</translation>
    </message>
    <message>
        <source>{0} min</source>
        <translation>{0} 分</translation>
    </message>
    <message>
        <source>{0:.1f} h</source>
        <translation>{0:.1f} 時間</translation>
    </message>
    <message>
        <source>{0}, about {1} left</source>
        <translation>{0}（残り約{1}）</translation>
    </message>
    <message>
        <source>The job has a step “{0}”, which is no algorithm of this version: update the plugin.</source>
        <translation>作業の手順「{0}」は、このバージョンにないアルゴリズムです。プラグインを更新してください。</translation>
    </message>
    <message>
        <source>{0} has no parameter {1}: correct the job.</source>
        <translation>{0}にパラメータ{1}はありません。作業を修正してください。</translation>
    </message>
    <message>
        <source>{0}: “{1}” takes one file, but the job gives {2}: leave one.</source>
        <translation>{0}：「{1}」に指定できるのは1ファイルですが、作業では{2}ファイルです。1つにしてください。</translation>
    </message>
    <message>
        <source>The folder of the results cannot be made ({0}): save the job in another folder by “Save job as…”.</source>
        <translation>結果のフォルダを作成できません（{0}）。「名前を付けて作業を保存…」で別のフォルダに保存してください。</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名前</translation>
    </message>
    <message>
        <source>Step by step, with pictures</source>
        <translation>画面の絵つきの手順</translation>
    </message>
    <message>
        <source>How it works</source>
        <translation>処理の仕組み</translation>
    </message>
    <message>
        <source>{0} of {1} walls by GNSS are adjusted or likely and are used.</source>
        <translation>GNSSによる壁面 {1} 件のうち、調整済みまたは推定の {0} 件を使います。</translation>
    </message>
    <message>
        <source>{0}: no feature has a polygon; choose a layer of outlines or building models.</source>
        <translation>{0}: ポリゴンを持つ地物がありません。外周線または建物モデルのレイヤを選択してください。</translation>
    </message>
    <message>
        <source>{0}: these are no walls with status and sigma; give the layer of walls of “Adjust walls by GNSS”.</source>
        <translation>{0}：status と sigma を持つ壁面ではありません。「GNSSによる壁面の調整」の壁面レイヤを指定してください。</translation>
    </message>
    <message>
        <source>no CRS</source>
        <translation>座標参照系なし</translation>
    </message>
    <message>
        <source>unnamed</source>
        <translation>名称なし</translation>
    </message>
    <message>
        <source>{0}: the coordinate reference system is missing; assign the one that the data are in (for a layer: Layer &gt; Set CRS).</source>
        <translation>{0}: 座標参照系がありません。データの座標参照系を設定してください（レイヤの場合: レイヤ &gt; レイヤのCRSを設定）。</translation>
    </message>
    <message>
        <source>{0}: coordinates are degrees in {1}; reproject to a projected CRS in metres, such as the local plane rectangular or UTM zone.</source>
        <translation>{0}: 座標が度単位です（{1}）。平面直角座標系やUTMなど、メートル単位の投影座標参照系に変換してください。</translation>
    </message>
    <message>
        <source>{0}: {1} counts in units of {2:.4f} m; reproject to a CRS in metres.</source>
        <translation>{0}: {1}の単位は{2:.4f} mです。メートル単位の座標参照系に変換してください。</translation>
    </message>
    <message>
        <source>{0}: {1} counts heights in units of {2:.4f} m; convert them to metres and assign a CRS that says so.</source>
        <translation>{0}: {1} の高さの単位は {2:.4f} m です。メートルに変換し、それを示す座標参照系を割り当ててください。</translation>
    </message>
    <message>
        <source>{0} is in {1}, but {2} is in {3}; reproject one of them.</source>
        <translation>{0}は{1}、{2}は{3}です。どちらかの座標系を変換してください。</translation>
    </message>
    <message>
        <source>{0}: the coordinate reference system is missing; assign the one that the data are in.</source>
        <translation>{0}: 座標参照系がありません。データの座標参照系を設定してください。</translation>
    </message>
    <message>
        <source>number in the point clouds</source>
        <translation>点群内の番号</translation>
    </message>
    <message>
        <source>object in the CityJSON file</source>
        <translation>CityJSONファイル内のオブジェクト</translation>
    </message>
    <message>
        <source>id in the city model</source>
        <translation>gml:id</translation>
    </message>
    <message>
        <source>measured wall</source>
        <translation>計測壁面</translation>
    </message>
    <message>
        <source>edge of the outline</source>
        <translation>外周線の辺</translation>
    </message>
    <message>
        <source>bound</source>
        <translation>境界線</translation>
    </message>
    <message>
        <source>area</source>
        <translation>領域</translation>
    </message>
    <message>
        <source>patch</source>
        <translation>パッチ</translation>
    </message>
    <message>
        <source>chain of parts</source>
        <translation>部分の連なり</translation>
    </message>
    <message>
        <source>chain of the double line</source>
        <translation>二重線の相手</translation>
    </message>
    <message>
        <source>element of the file</source>
        <translation>ファイルの要素</translation>
    </message>
    <message>
        <source>seam of tiles</source>
        <translation>タイルの継ぎ目</translation>
    </message>
    <message>
        <source>change</source>
        <translation>変化</translation>
    </message>
    <message>
        <source>change of height (m)</source>
        <translation>高さの変化（m）</translation>
    </message>
    <message>
        <source>change of area (m²)</source>
        <translation>面積の変化（m²）</translation>
    </message>
    <message>
        <source>significance (standard deviations)</source>
        <translation>有意性（標準偏差の倍数）</translation>
    </message>
    <message>
        <source>day of the survey</source>
        <translation>計測日</translation>
    </message>
    <message>
        <source>reason</source>
        <translation>理由</translation>
    </message>
    <message>
        <source>kind that is next likely</source>
        <translation>次に確からしい種類</translation>
    </message>
    <message>
        <source>note</source>
        <translation>備考</translation>
    </message>
    <message>
        <source>problems</source>
        <translation>問題</translation>
    </message>
    <message>
        <source>what was found</source>
        <translation>見つかった内容</translation>
    </message>
    <message>
        <source>rule</source>
        <translation>規則</translation>
    </message>
    <message>
        <source>severity</source>
        <translation>重大度</translation>
    </message>
    <message>
        <source>kind</source>
        <translation>種別</translation>
    </message>
    <message>
        <source>class</source>
        <translation>クラス</translation>
    </message>
    <message>
        <source>colour</source>
        <translation>色</translation>
    </message>
    <message>
        <source>evidence of the direction</source>
        <translation>方向の根拠</translation>
    </message>
    <message>
        <source>quality, 0 to 1</source>
        <translation>品質（0～1）</translation>
    </message>
    <message>
        <source>confidence, 0 to 1</source>
        <translation>信頼度（0～1）</translation>
    </message>
    <message>
        <source>coverage, 0 to 1</source>
        <translation>被覆率（0～1）</translation>
    </message>
    <message>
        <source>agreement with the shape, 0 to 1</source>
        <translation>形状との一致度、0～1</translation>
    </message>
    <message>
        <source>weight kept, 0 to 1</source>
        <translation>残された重み、0～1</translation>
    </message>
    <message>
        <source>points a m²</source>
        <translation>1 m²あたりの点数</translation>
    </message>
    <message>
        <source>passes that saw it</source>
        <translation>観測した走行回数</translation>
    </message>
    <message>
        <source>time (s)</source>
        <translation>時刻 (s)</translation>
    </message>
    <message>
        <source>chainage (m)</source>
        <translation>縦断距離 (m)</translation>
    </message>
    <message>
        <source>other drive</source>
        <translation>相手の走行</translation>
    </message>
    <message>
        <source>in plan (m)</source>
        <translation>水平 (m)</translation>
    </message>
    <message>
        <source>roll (°)</source>
        <translation>ロール (°)</translation>
    </message>
    <message>
        <source>pitch (°)</source>
        <translation>ピッチ (°)</translation>
    </message>
    <message>
        <source>heading (°)</source>
        <translation>方位 (°)</translation>
    </message>
    <message>
        <source>azimuth (°)</source>
        <translation>方位角 (°)</translation>
    </message>
    <message>
        <source>x (m)</source>
        <translation>x (m)</translation>
    </message>
    <message>
        <source>y (m)</source>
        <translation>y (m)</translation>
    </message>
    <message>
        <source>z (m)</source>
        <translation>z (m)</translation>
    </message>
    <message>
        <source>length (m)</source>
        <translation>長さ (m)</translation>
    </message>
    <message>
        <source>width (m)</source>
        <translation>幅 (m)</translation>
    </message>
    <message>
        <source>narrowest width (m)</source>
        <translation>最小幅 (m)</translation>
    </message>
    <message>
        <source>height (m)</source>
        <translation>高さ (m)</translation>
    </message>
    <message>
        <source>highest point (m)</source>
        <translation>最高点 (m)</translation>
    </message>
    <message>
        <source>area (m²)</source>
        <translation>面積 (m²)</translation>
    </message>
    <message>
        <source>volume (m³)</source>
        <translation>体積 (m³)</translation>
    </message>
    <message>
        <source>slope (°)</source>
        <translation>勾配 (°)</translation>
    </message>
    <message>
        <source>lean backwards (°)</source>
        <translation>後方への傾き (°)</translation>
    </message>
    <message>
        <source>distance (m)</source>
        <translation>距離 (m)</translation>
    </message>
    <message>
        <source>offset (m)</source>
        <translation>オフセット (m)</translation>
    </message>
    <message>
        <source>standard deviation of the height (m)</source>
        <translation>高さの標準偏差 (m)</translation>
    </message>
    <message>
        <source>standard deviation, east (m)</source>
        <translation>東方向の標準偏差 (m)</translation>
    </message>
    <message>
        <source>standard deviation, north (m)</source>
        <translation>北方向の標準偏差 (m)</translation>
    </message>
    <message>
        <source>standard deviation of the roll (°)</source>
        <translation>ロールの標準偏差 (°)</translation>
    </message>
    <message>
        <source>standard deviation of the pitch (°)</source>
        <translation>ピッチの標準偏差 (°)</translation>
    </message>
    <message>
        <source>standard deviation of the heading (°)</source>
        <translation>方位の標準偏差 (°)</translation>
    </message>
    <message>
        <source>RMSE of the height (m)</source>
        <translation>高さのRMSE (m)</translation>
    </message>
    <message>
        <source>RMSE of the height, best 95 % (m)</source>
        <translation>高さのRMSE、良い方の95 % (m)</translation>
    </message>
    <message>
        <source>median height difference (m)</source>
        <translation>高さの較差の中央値 (m)</translation>
    </message>
    <message>
        <source>RMSE of the distance (m)</source>
        <translation>距離のRMSE (m)</translation>
    </message>
    <message>
        <source>95th percentile of the distance (m)</source>
        <translation>距離の95パーセンタイル (m)</translation>
    </message>
    <message>
        <source>maximum distance (m)</source>
        <translation>最大距離 (m)</translation>
    </message>
    <message>
        <source>points within the error, 0 to 1</source>
        <translation>許容誤差内の点の割合、0～1</translation>
    </message>
    <message>
        <source>residual (m)</source>
        <translation>残差 (m)</translation>
    </message>
    <message>
        <source>error east, before (m)</source>
        <translation>東方向の誤差、補正前 (m)</translation>
    </message>
    <message>
        <source>error north, before (m)</source>
        <translation>北方向の誤差、補正前 (m)</translation>
    </message>
    <message>
        <source>error up, before (m)</source>
        <translation>高さの誤差、補正前 (m)</translation>
    </message>
    <message>
        <source>error in plan, before (m)</source>
        <translation>水平誤差、補正前 (m)</translation>
    </message>
    <message>
        <source>error in space, before (m)</source>
        <translation>三次元誤差、補正前 (m)</translation>
    </message>
    <message>
        <source>error east, after (m)</source>
        <translation>東方向の誤差、補正後 (m)</translation>
    </message>
    <message>
        <source>error north, after (m)</source>
        <translation>北方向の誤差、補正後 (m)</translation>
    </message>
    <message>
        <source>error up, after (m)</source>
        <translation>高さの誤差、補正後 (m)</translation>
    </message>
    <message>
        <source>error in plan, after (m)</source>
        <translation>水平誤差、補正後 (m)</translation>
    </message>
    <message>
        <source>error in space, after (m)</source>
        <translation>三次元誤差、補正後 (m)</translation>
    </message>
    <message>
        <source>error east, left out (m)</source>
        <translation>東の誤差、除外時 (m)</translation>
    </message>
    <message>
        <source>error north, left out (m)</source>
        <translation>北の誤差、除外時 (m)</translation>
    </message>
    <message>
        <source>error up, left out (m)</source>
        <translation>高さの誤差、除外時 (m)</translation>
    </message>
    <message>
        <source>frames that see it</source>
        <translation>写っている写真の数</translation>
    </message>
    <message>
        <source>is it paint? (yes or no)</source>
        <translation>標示ですか（はい・いいえ）</translation>
    </message>
    <message>
        <source>standard deviation of the width (m)</source>
        <translation>幅の標準偏差 (m)</translation>
    </message>
    <message>
        <source>standard deviations across, in metres, from vertex to vertex</source>
        <translation>横方向の標準偏差（m）、頂点ごと</translation>
    </message>
    <message>
        <source>lanes that it lets pass</source>
        <translation>優先させる車線</translation>
    </message>
    <message>
        <source>why it yields</source>
        <translation>譲る理由</translation>
    </message>
    <message>
        <source>number of the road surface</source>
        <translation>道路面の番号</translation>
    </message>
    <message>
        <source>function (code)</source>
        <translation>機能（コード）</translation>
    </message>
    <message>
        <source>usage (code)</source>
        <translation>用途（コード）</translation>
    </message>
    <message>
        <source>kind of section (code)</source>
        <translation>区間の種別（コード）</translation>
    </message>
    <message>
        <source>species (code)</source>
        <translation>樹種（コード）</translation>
    </message>
    <message>
        <source>roads that meet</source>
        <translation>交わる道路の数</translation>
    </message>
    <message>
        <source>finding</source>
        <translation>指摘</translation>
    </message>
    <message>
        <source>parts</source>
        <translation>部分</translation>
    </message>
    <message>
        <source>height of the base (m)</source>
        <translation>底面の標高 (m)</translation>
    </message>
    <message>
        <source>height of the ground (m)</source>
        <translation>地表の標高 (m)</translation>
    </message>
    <message>
        <source>height of the top (m)</source>
        <translation>上端の標高 (m)</translation>
    </message>
    <message>
        <source>height of the ground face (m)</source>
        <translation>底面の高さ (m)</translation>
    </message>
    <message>
        <source>share without points, 0 to 1</source>
        <translation>点のない割合、0～1</translation>
    </message>
    <message>
        <source>points far from the model, 0 to 1</source>
        <translation>モデルから離れた点の割合、0～1</translation>
    </message>
    <message>
        <source>level of detail</source>
        <translation>LOD</translation>
    </message>
    <message>
        <source>kind of roof</source>
        <translation>屋根の種別</translation>
    </message>
    <message>
        <source>kind of surface</source>
        <translation>面の種別</translation>
    </message>
    <message>
        <source>valid solid</source>
        <translation>有効な立体</translation>
    </message>
    <message>
        <source>watertight</source>
        <translation>水密</translation>
    </message>
    <message>
        <source>triangles</source>
        <translation>三角形</translation>
    </message>
    <message>
        <source>lowest roof above the ground (m)</source>
        <translation>最も低い屋根の地上高 (m)</translation>
    </message>
    <message>
        <source>roof height above the ground, half of the area below (m)</source>
        <translation>屋根の地上高（面積の半分がこれより低い） (m)</translation>
    </message>
    <message>
        <source>roof height above the ground, 70 % of the area below (m)</source>
        <translation>屋根の地上高（面積の70 %がこれより低い） (m)</translation>
    </message>
    <message>
        <source>highest roof above the ground (m)</source>
        <translation>最も高い屋根の地上高 (m)</translation>
    </message>
    <message>
        <source>volume at LOD 1.2 (m³)</source>
        <translation>LOD 1.2の体積 (m³)</translation>
    </message>
    <message>
        <source>volume at LOD 1.3 (m³)</source>
        <translation>LOD 1.3の体積 (m³)</translation>
    </message>
    <message>
        <source>volume at LOD 2.2 (m³)</source>
        <translation>LOD 2.2の体積 (m³)</translation>
    </message>
    <message>
        <source>area of the ground face (m²)</source>
        <translation>底面の面積 (m²)</translation>
    </message>
    <message>
        <source>area of flat roofs (m²)</source>
        <translation>陸屋根の面積 (m²)</translation>
    </message>
    <message>
        <source>area of sloped roofs (m²)</source>
        <translation>勾配屋根の面積 (m²)</translation>
    </message>
    <message>
        <source>area of outer walls (m²)</source>
        <translation>外壁の面積 (m²)</translation>
    </message>
    <message>
        <source>area of party walls (m²)</source>
        <translation>界壁の面積 (m²)</translation>
    </message>
    <message>
        <source>storeys, estimated</source>
        <translation>推定階数</translation>
    </message>
    <message>
        <source>date of the data</source>
        <translation>データの日付</translation>
    </message>
    <message>
        <source>attributes of the file</source>
        <translation>ファイルの属性</translation>
    </message>
    <message>
        <source>shift east (m)</source>
        <translation>東方向のずれ (m)</translation>
    </message>
    <message>
        <source>shift north (m)</source>
        <translation>北方向のずれ (m)</translation>
    </message>
    <message>
        <source>standard deviation of the shift (m)</source>
        <translation>ずれの標準偏差 (m)</translation>
    </message>
    <message>
        <source>status of the shift</source>
        <translation>ずれの状態</translation>
    </message>
    <message>
        <source>points a m² of the cloud round it</source>
        <translation>周囲の点群の密度（点/m²）</translation>
    </message>
    <message>
        <source>beyond the cloud's edge, 0 to 1</source>
        <translation>点群の端の外の割合、0～1</translation>
    </message>
    <message>
        <source>open ground, 0 to 1</source>
        <translation>開けた地面の割合、0～1</translation>
    </message>
    <message>
        <source>outer walls</source>
        <translation>外壁</translation>
    </message>
    <message>
        <source>walls moved</source>
        <translation>移動した壁面</translation>
    </message>
    <message>
        <source>length on measured walls, 0 to 1</source>
        <translation>計測壁面上の長さの割合、0～1</translation>
    </message>
    <message>
        <source>mean offset (m)</source>
        <translation>平均オフセット (m)</translation>
    </message>
    <message>
        <source>maximum offset (m)</source>
        <translation>最大オフセット (m)</translation>
    </message>
    <message>
        <source>change of the volume (m³)</source>
        <translation>体積の変化 (m³)</translation>
    </message>
    <message>
        <source>walls adjusted</source>
        <translation>壁面を調整</translation>
    </message>
    <message>
        <source>largest move of a wall (m)</source>
        <translation>壁面の最大移動量 (m)</translation>
    </message>
    <message>
        <source>normal, east</source>
        <translation>法線、東成分</translation>
    </message>
    <message>
        <source>normal, north</source>
        <translation>法線、北成分</translation>
    </message>
    <message>
        <source>normal, up</source>
        <translation>法線、上成分</translation>
    </message>
    <message>
        <source>spread between passes (m)</source>
        <translation>走行間のばらつき (m)</translation>
    </message>
    <message>
        <source>hidden by what stands in front, 0 to 1</source>
        <translation>手前の物に隠れた割合、0～1</translation>
    </message>
    <message>
        <source>openings, 0 to 1</source>
        <translation>開口部の割合、0～1</translation>
    </message>
    <message>
        <source>beams went through, 0 to 1</source>
        <translation>ビームが通り抜けた割合、0～1</translation>
    </message>
    <message>
        <source>filled gaps, 0 to 1</source>
        <translation>補間した欠損の割合、0～1</translation>
    </message>
    <message>
        <source>turn (°)</source>
        <translation>回転 (°)</translation>
    </message>
    <message>
        <source>share seen, 0 to 1</source>
        <translation>見えた割合、0～1</translation>
    </message>
    <message>
        <source>pixel on the facade (m)</source>
        <translation>壁面上の画素寸法 (m)</translation>
    </message>
    <message>
        <source>height of the lower edge (m)</source>
        <translation>下端の標高 (m)</translation>
    </message>
    <message>
        <source>height of the upper edge (m)</source>
        <translation>上端の標高 (m)</translation>
    </message>
    <message>
        <source>height of the foot (m)</source>
        <translation>下端の高さ (m)</translation>
    </message>
    <message>
        <source>moved by (m)</source>
        <translation>移動量 (m)</translation>
    </message>
    <message>
        <source>observations</source>
        <translation>観測値数</translation>
    </message>
    <message>
        <source>signals</source>
        <translation>信号</translation>
    </message>
    <message>
        <source>observations neither delayed nor outliers, 0 to 1</source>
        <translation>遅延でも外れ値でもない観測の割合、0～1</translation>
    </message>
    <message>
        <source>GLONASS</source>
        <translation>GLONASS</translation>
    </message>
    <message>
        <source>Galileo</source>
        <translation>Galileo</translation>
    </message>
    <message>
        <source>BeiDou</source>
        <translation>BeiDou</translation>
    </message>
    <message>
        <source>QZSS</source>
        <translation>QZSS</translation>
    </message>
    <message>
        <source>satellites above the mask</source>
        <translation>仰角マスク以上の衛星数</translation>
    </message>
    <message>
        <source>pass</source>
        <translation>走行</translation>
    </message>
    <message>
        <source>system</source>
        <translation>衛星系</translation>
    </message>
    <message>
        <source>class is sure</source>
        <translation>分類が確実</translation>
    </message>
    <message>
        <source>elevation (°)</source>
        <translation>仰角 (°)</translation>
    </message>
    <message>
        <source>C/N0 (dB-Hz)</source>
        <translation>C/N0 (dB-Hz)</translation>
    </message>
    <message>
        <source>excess path, predicted (m)</source>
        <translation>予測した経路超過 (m)</translation>
    </message>
    <message>
        <source>residual less prediction (m)</source>
        <translation>残差と予測の差 (m)</translation>
    </message>
    <message>
        <source>walls that may reflect</source>
        <translation>反射し得る壁面</translation>
    </message>
    <message>
        <source>contrast (grey values)</source>
        <translation>コントラスト（階調）</translation>
    </message>
    <message>
        <source>length without paint that should be there (m)</source>
        <translation>標示があるはずで無い長さ (m)</translation>
    </message>
    <message>
        <source>dash and gap together (m)</source>
        <translation>標示部分と間隔の合計 (m)</translation>
    </message>
    <message>
        <source>length of a dash (m)</source>
        <translation>標示部分の長さ (m)</translation>
    </message>
    <message>
        <source>ends of worn dashes, placed by the others, m along the line</source>
        <translation>摩耗した標示端のうちほかから位置を決めたもの、線に沿ったm</translation>
    </message>
    <message>
        <source>begin and end of the dashes, m along the line</source>
        <translation>標示部分の始点と終点、線に沿ったm</translation>
    </message>
    <message>
        <source>standard deviation along the road (m)</source>
        <translation>道路方向の標準偏差 (m)</translation>
    </message>
    <message>
        <source>standard deviation across the road (m)</source>
        <translation>道路直交方向の標準偏差 (m)</translation>
    </message>
    <message>
        <source>measured share of the line, 0 to 1</source>
        <translation>線の実測割合、0～1</translation>
    </message>
    <message>
        <source>gap to the next part (m)</source>
        <translation>次の部分までの間隔 (m)</translation>
    </message>
    <message>
        <source>number</source>
        <translation>件数</translation>
    </message>
    <message>
        <source>diameter of the stem (m)</source>
        <translation>柱・幹の直径 (m)</translation>
    </message>
    <message>
        <source>lean from the plumb line (°)</source>
        <translation>鉛直からの傾き (°)</translation>
    </message>
    <message>
        <source>diameter of the crown (m)</source>
        <translation>樹冠の直径 (m)</translation>
    </message>
    <message>
        <source>length of the arm (m)</source>
        <translation>腕木の長さ (m)</translation>
    </message>
    <message>
        <source>height of the arm over the ground (m)</source>
        <translation>腕木の地面からの高さ (m)</translation>
    </message>
    <message>
        <source>height of what is at the arm's end (m)</source>
        <translation>腕木の先にあるものの高さ (m)</translation>
    </message>
    <message>
        <source>width of the board (m)</source>
        <translation>標識板の幅 (m)</translation>
    </message>
    <message>
        <source>height of the board (m)</source>
        <translation>標識板の高さ (m)</translation>
    </message>
    <message>
        <source>elevation of the board's middle (m)</source>
        <translation>標識板の中心の標高 (m)</translation>
    </message>
    <message>
        <source>arrows</source>
        <translation>矢印</translation>
    </message>
    <message>
        <source>lanes that follow</source>
        <translation>次の車線</translation>
    </message>
    <message>
        <source>lane on the left</source>
        <translation>左の車線</translation>
    </message>
    <message>
        <source>lane on the right</source>
        <translation>右の車線</translation>
    </message>
    <message>
        <source>oncoming lane beside</source>
        <translation>隣の対向車線</translation>
    </message>
    <message>
        <source>stop lines</source>
        <translation>停止線</translation>
    </message>
    <message>
        <source>crosswalks</source>
        <translation>横断歩道</translation>
    </message>
    <message>
        <source>speed limit (km/h)</source>
        <translation>制限速度 (km/h)</translation>
    </message>
    <message>
        <source>double line</source>
        <translation>二重線</translation>
    </message>
    <message>
        <source>lanes that have it</source>
        <translation>この線をもつ車線</translation>
    </message>
    <message>
        <source>along the road, by walls (m)</source>
        <translation>道路方向、壁面による (m)</translation>
    </message>
    <message>
        <source>across the road, by walls (m)</source>
        <translation>道路直交方向、壁面による (m)</translation>
    </message>
    <message>
        <source>heading, by walls (°)</source>
        <translation>方位、壁面による (°)</translation>
    </message>
    <message>
        <source>along the road, by markings (m)</source>
        <translation>道路方向、路面標示による (m)</translation>
    </message>
    <message>
        <source>across the road, by markings (m)</source>
        <translation>道路直交方向、路面標示による (m)</translation>
    </message>
    <message>
        <source>heading, by markings (°)</source>
        <translation>方位、路面標示による (°)</translation>
    </message>
    <message>
        <source>along the road, by satellites (m)</source>
        <translation>道路方向、衛星による (m)</translation>
    </message>
    <message>
        <source>across the road, by satellites (m)</source>
        <translation>道路直交方向、衛星による (m)</translation>
    </message>
    <message>
        <source>heading, by satellites (°)</source>
        <translation>方位、衛星による (°)</translation>
    </message>
    <message>
        <source>error ellipse, semi-major axis (m)</source>
        <translation>誤差楕円の長半径 (m)</translation>
    </message>
    <message>
        <source>error ellipse, semi-minor axis (m)</source>
        <translation>誤差楕円の短半径 (m)</translation>
    </message>
    <message>
        <source>weakest direction (°)</source>
        <translation>最も弱い方向 (°)</translation>
    </message>
    <message>
        <source>directions not determined, 0 to 2</source>
        <translation>決まらない方向の数、0～2</translation>
    </message>
    <message>
        <source>scans that end elsewhere, 0 to 1</source>
        <translation>別の場所に収束するスキャン、0～1</translation>
    </message>
    <message>
        <source>probability of other places, 0 to 1</source>
        <translation>他の場所である確率、0～1</translation>
    </message>
    <message>
        <source>distance of the likeliest other place (m)</source>
        <translation>最も紛らわしい場所までの距離 (m)</translation>
    </message>
    <message>
        <source>direction of the likeliest other place (°)</source>
        <translation>最も紛らわしい場所の方向 (°)</translation>
    </message>
    <message>
        <source>horizon with a wall, 0 to 1</source>
        <translation>壁面がある水平方向の割合、0～1</translation>
    </message>
    <message>
        <source>sky hidden by buildings, 0 to 1</source>
        <translation>建物に隠れた天空の割合、0～1</translation>
    </message>
    <message>
        <source>walls from the plane of their cell, RMS (m)</source>
        <translation>セルの平面からの壁面のずれ、RMS (m)</translation>
    </message>
    <message>
        <source>points where two surfaces meet, 0 to 1</source>
        <translation>二つの面が接する点の割合、0～1</translation>
    </message>
    <message>
        <source>first image</source>
        <translation>一枚目の画像</translation>
    </message>
    <message>
        <source>second image</source>
        <translation>二枚目の画像</translation>
    </message>
    <message>
        <source>median of the pair, east (m)</source>
        <translation>組の中央値、東方向 (m)</translation>
    </message>
    <message>
        <source>median of the pair, north (m)</source>
        <translation>組の中央値、北方向 (m)</translation>
    </message>
    <message>
        <source>median of the pair (m)</source>
        <translation>組の中央値 (m)</translation>
    </message>
    <message>
        <source>standard deviation of the median (m)</source>
        <translation>中央値の標準偏差 (m)</translation>
    </message>
    <message>
        <source>places compared</source>
        <translation>比較した箇所</translation>
    </message>
    <message>
        <source>pairs</source>
        <translation>対応点</translation>
    </message>
    <message>
        <source>distance before (m)</source>
        <translation>補正前の距離 (m)</translation>
    </message>
    <message>
        <source>distance after (m)</source>
        <translation>補正後の距離 (m)</translation>
    </message>
    <message>
        <source>misfit within the set (m)</source>
        <translation>組の中の不一致 (m)</translation>
    </message>
    <message>
        <source>off without itself (m)</source>
        <translation>一つ抜き残差 (m)</translation>
    </message>
    <message>
        <source>corners shifted likewise</source>
        <translation>同様にずれた角</translation>
    </message>
    <message>
        <source>RMS of the walls (m)</source>
        <translation>壁面のRMS (m)</translation>
    </message>
    <message>
        <source>length of the window (m)</source>
        <translation>ウィンドウの長さ (m)</translation>
    </message>
    <message>
        <source>cells or points with paint</source>
        <translation>標示のあるセルまたは点</translation>
    </message>
    <message>
        <source>paint on the reference, 0 to 1</source>
        <translation>基準上にある標示の割合、0～1</translation>
    </message>
    <message>
        <source>lead over other places (log-likelihood)</source>
        <translation>他の場所に対する優位（対数尤度）</translation>
    </message>
    <message>
        <source>parameter</source>
        <translation>パラメータ</translation>
    </message>
    <message>
        <source>time taken (s)</source>
        <translation>所要時間 (s)</translation>
    </message>
    <message>
        <source>memory (MB)</source>
        <translation>メモリ (MB)</translation>
    </message>
    <message>
        <source>standard deviation of the edges (m)</source>
        <translation>道路縁の標準偏差（m）</translation>
    </message>
    <message>
        <source>height above the ground (m)</source>
        <translation>地表からの高さ (m)</translation>
    </message>
    <message>
        <source>height of the roof (m)</source>
        <translation>屋根の標高 (m)</translation>
    </message>
    <message>
        <source>length without a line (m)</source>
        <translation>線のない長さ (m)</translation>
    </message>
    <message>
        <source>standard deviation across (m)</source>
        <translation>直交方向の標準偏差 (m)</translation>
    </message>
    <message>
        <source>where its border is from</source>
        <translation>境界の出典</translation>
    </message>
    <message>
        <source>share of the border measured as a kerb, 0 to 1</source>
        <translation>縁石として計測した境界の割合（0～1）</translation>
    </message>
    <message>
        <source>highest step (m)</source>
        <translation>最大の段差（m）</translation>
    </message>
    <message>
        <source>height of the step (m)</source>
        <translation>段差の高さ（m）</translation>
    </message>
    <message>
        <source>where the edges are from</source>
        <translation>道路縁の出典</translation>
    </message>
    <message>
        <source>height above the road (m)</source>
        <translation>路面からの高さ (m)</translation>
    </message>
    <message>
        <source>object in the city model</source>
        <translation>都市モデルでの地物 ID</translation>
    </message>
    <message>
        <source>standard deviation east and north (m)</source>
        <translation>東・北の標準偏差 (m)</translation>
    </message>
    <message>
        <source>direction of board or arm (°)</source>
        <translation>標識板または腕の方位 (°)</translation>
    </message>
    <message>
        <source>width of the stroke (m)</source>
        <translation>線の幅 (m)</translation>
    </message>
    <message>
        <source>direction of reading (°)</source>
        <translation>読む方向 (°)</translation>
    </message>
    <message>
        <source>turn</source>
        <translation>進行方向</translation>
    </message>
    <message>
        <source>expected error of the height (m)</source>
        <translation>高さの予想誤差（m）</translation>
    </message>
    <message>
        <source>not seen, nothing in front, 0 to 1</source>
        <translation>手前に何もないのに見えない割合、0～1</translation>
    </message>
    <message>
        <source>before the outline (m)</source>
        <translation>外周線より手前 (m)</translation>
    </message>
    <message>
        <source>offset from the model (m)</source>
        <translation>モデルからのオフセット (m)</translation>
    </message>
    <message>
        <source>offset outwards (m)</source>
        <translation>外側へのオフセット (m)</translation>
    </message>
    <message>
        <source>distance of the nearest antenna (m)</source>
        <translation>最も近いアンテナの距離 (m)</translation>
    </message>
    <message>
        <source>residual less the receiver clock (m)</source>
        <translation>受信機時計を除いた残差 (m)</translation>
    </message>
    <message>
        <source>azimuth from grid north (°)</source>
        <translation>座標北からの方位角 (°)</translation>
    </message>
    <message>
        <source>wall: edge of the outline</source>
        <translation>壁面：外周線の辺</translation>
    </message>
    <message>
        <source>begins at chainage (m)</source>
        <translation>始点の追加距離（m）</translation>
    </message>
    <message>
        <source>ends at chainage (m)</source>
        <translation>終点の追加距離（m）</translation>
    </message>
    <message>
        <source>size of the step (m)</source>
        <translation>段差の大きさ（m）</translation>
    </message>
    <message>
        <source>towards, from grid north (°)</source>
        <translation>方向、座標北から（°）</translation>
    </message>
    <message>
        <source>step east (m)</source>
        <translation>段差 東（m）</translation>
    </message>
    <message>
        <source>step north (m)</source>
        <translation>段差 北（m）</translation>
    </message>
    <message>
        <source>correction east (m)</source>
        <translation>補正量、東 (m)</translation>
    </message>
    <message>
        <source>correction north (m)</source>
        <translation>補正量、北 (m)</translation>
    </message>
    <message>
        <source>correction up (m)</source>
        <translation>補正量、上 (m)</translation>
    </message>
    <message>
        <source>correction of the roll (°)</source>
        <translation>ロールの補正量 (°)</translation>
    </message>
    <message>
        <source>correction of the pitch (°)</source>
        <translation>ピッチの補正量 (°)</translation>
    </message>
    <message>
        <source>correction of the heading (°)</source>
        <translation>方位の補正量 (°)</translation>
    </message>
    <message>
        <source>score of the window, 0 to 1</source>
        <translation>ウィンドウの評価値、0～1</translation>
    </message>
    <message>
        <source>weight of its own evidence, 0 to 1</source>
        <translation>自身の観測の重み、0～1</translation>
    </message>
    <message>
        <source>correction in plan (m)</source>
        <translation>水平補正量 (m)</translation>
    </message>
    <message>
        <source>correction, in the unit beside</source>
        <translation>補正量（単位は隣の列）</translation>
    </message>
    <message>
        <source>standard deviation, in the unit beside</source>
        <translation>標準偏差（単位は隣の列）</translation>
    </message>
    <message>
        <source>standard deviation in plan (m)</source>
        <translation>水平の標準偏差 (m)</translation>
    </message>
    <message>
        <source>standard deviation in plan, relative to the reference (m)</source>
        <translation>基準に対する水平位置の標準偏差（m）</translation>
    </message>
    <message>
        <source>own correction less the smooth one (m)</source>
        <translation>自身の補正量と平滑化後の差 (m)</translation>
    </message>
    <message>
        <source>marking points</source>
        <translation>路面標示の点</translation>
    </message>
    <message>
        <source>residual east (m)</source>
        <translation>残差、東 (m)</translation>
    </message>
    <message>
        <source>residual north (m)</source>
        <translation>残差、北 (m)</translation>
    </message>
    <message>
        <source>residual up (m)</source>
        <translation>残差、上 (m)</translation>
    </message>
    <message>
        <source>residual in plan (m)</source>
        <translation>水平残差 (m)</translation>
    </message>
    <message>
        <source>shift (m)</source>
        <translation>移動量 (m)</translation>
    </message>
    <message>
        <source>standard deviation of one place (m)</source>
        <translation>一箇所の標準偏差 (m)</translation>
    </message>
    <message>
        <source>survey to reference (m)</source>
        <translation>計測から基準まで (m)</translation>
    </message>
    <message>
        <source>laser rays on walls</source>
        <translation>壁面に当たるレーザ光線</translation>
    </message>
    <message>
        <source>satellites in line of sight</source>
        <translation>見通し内の衛星数</translation>
    </message>
    <message>
        <source>heading of the road (°)</source>
        <translation>道路の方位 (°)</translation>
    </message>
    <message>
        <source>height of the building (m)</source>
        <translation>建物の高さ (m)</translation>
    </message>
    <message>
        <source>height above the base (m)</source>
        <translation>底面からの高さ (m)</translation>
    </message>
    <message>
        <source>kind of building</source>
        <translation>建物の種別</translation>
    </message>
    <message>
        <source>id in the GSI data</source>
        <translation>国土地理院データのID</translation>
    </message>
    <message>
        <source>fid in the GSI data</source>
        <translation>国土地理院データのfid</translation>
    </message>
    <message>
        <source>existing since</source>
        <translation>存在開始</translation>
    </message>
    <message>
        <source>existing until</source>
        <translation>存在終了</translation>
    </message>
    <message>
        <source>date of the survey</source>
        <translation>測量日</translation>
    </message>
    <message>
        <source>scale of the source map (1 : n)</source>
        <translation>原図の縮尺（1 : n）</translation>
    </message>
    <message>
        <source>source’s metadata</source>
        <translation>元データのメタデータ</translation>
    </message>
    <message>
        <source>file</source>
        <translation>ファイル</translation>
    </message>
    <message>
        <source>source of the rule</source>
        <translation>規則の出典</translation>
    </message>
    <message>
        <source>element of the map</source>
        <translation>地図の要素</translation>
    </message>
    <message>
        <source>in the old map</source>
        <translation>旧地図での種別</translation>
    </message>
    <message>
        <source>in the new map</source>
        <translation>新地図での種別</translation>
    </message>
    <message>
        <source>shift along (m)</source>
        <translation>縦方向の移動量 (m)</translation>
    </message>
    <message>
        <source>shift to the left (m)</source>
        <translation>左方向の移動量 (m)</translation>
    </message>
    <message>
        <source>shift over sigma</source>
        <translation>移動量÷標準偏差</translation>
    </message>
    <message>
        <source>id in the old map</source>
        <translation>旧地図の id</translation>
    </message>
    <message>
        <source>id in the new map</source>
        <translation>新地図の id</translation>
    </message>
    <message>
        <source>requirement</source>
        <translation>品質要求</translation>
    </message>
    <message>
        <source>kind of feature</source>
        <translation>地物型</translation>
    </message>
    <message>
        <source>The feature has no polygon.</source>
        <translation>地物にポリゴンがありません。</translation>
    </message>
    <message>
        <source>The polygon was invalid and was repaired ({0}).</source>
        <translation>ポリゴンが不正だったため修復しました（{0}）。</translation>
    </message>
    <message>
        <source>{0}: none of the {1} features has a polygon; choose a polygon layer.</source>
        <translation>{0}: 地物{1}件のいずれにもポリゴンがありません。ポリゴンレイヤを選択してください。</translation>
    </message>
    <message>
        <source>{0}: there are no polygons to work on; check the layer and its filter.</source>
        <translation>{0}: 処理対象のポリゴンがありません。レイヤとフィルタを確認してください。</translation>
    </message>
    <message>
        <source>{0}: {1} of {2} polygons are empty, or invalid and were repaired (feature ids {3}{4}).</source>
        <translation>{0}: ポリゴン{2}件中{1}件が空か、不正のため修復されました（地物id {3}{4}）。</translation>
    </message>
    <message>
        <source>{0} holds features of the kind {1}, not polygons; choose a polygon layer, or take the polygons out of it first.</source>
        <translation>{0} の地物は {1} で、ポリゴンではありません。ポリゴンのレイヤーを選ぶか、先にポリゴンを取り出してください。</translation>
    </message>
    <message>
        <source>{0} cannot be written; choose another output.</source>
        <translation>{0}に書き込めません。別の出力先を選択してください。</translation>
    </message>
    <message>
        <source>{0} cannot be written to {1}; choose another file.</source>
        <translation>{0}を{1}に書き込めません。別のファイルを選択してください。</translation>
    </message>
    <message>
        <source>{0} cannot be written ({1}); close the program that has it open.</source>
        <translation>{0}に書き込めません（{1}）。ファイルを開いているプログラムを閉じてください。</translation>
    </message>
    <message>
        <source>{0} was not written whole ({1}): make room on its disk, or choose another file.</source>
        <translation>{0} を最後まで書き込めませんでした({1})。ディスクの空きを増やすか、別のファイルを選んでください。</translation>
    </message>
    <message>
        <source>{0} cannot be written: {1}</source>
        <translation>{0}に書き込めません: {1}</translation>
    </message>
    <message>
        <source>{0}: the files state no coordinate reference system; they are taken to be in that of {1}, {2}.</source>
        <translation>{0}: ファイルに座標参照系の記載がありません。{1}の{2}とみなします。</translation>
    </message>
    <message>
        <source>{0} and {1} lie on each other only where x and y of one of them are swapped; swap them in the one that counts x to the north.</source>
        <translation>{0}と{1}は、一方のxとyを入れ替えた場合にのみ重なります。xが北向きの方のxとyを入れ替えてください。</translation>
    </message>
    <message>
        <source>{0}: the field {1} must hold the buildings' numbers as an earlier step wrote them; remove it.</source>
        <translation>{0}: フィールド{1}には前の処理が書いた建物番号が必要です。このフィールドを削除してください。</translation>
    </message>
    <message>
        <source>{0}: some {1} is empty; give each building its own, or remove the field.</source>
        <translation>{0}: {1}に空の値があります。建物ごとに値を付けるか、フィールドを削除してください。</translation>
    </message>
    <message>
        <source>{0} outlines have no usable polygon; their buildings keep their rows.</source>
        <translation>外周線{0}件に使用できるポリゴンがありません。該当する建物の行は残ります。</translation>
    </message>
    <message>
        <source>{0}: the field {1} must hold numbers; convert it or choose another field.</source>
        <translation>{0}: フィールド{1}は数値にしてください。変換するか、別のフィールドを選択してください。</translation>
    </message>
    <message>
        <source>{0}: the {1} {2} is there more than once; give each building its own, or remove the field.</source>
        <translation>{0}: {1} {2}が重複しています。建物ごとに固有の値を付けるか、フィールドを削除してください。</translation>
    </message>
    <message>
        <source>{0}: reprojected from {1} to {2}, the system of the points</source>
        <translation>{0}: {1}から点群の座標系{2}に変換しました</translation>
    </message>
    <message>
        <source>{0}: coordinates such as {1:.0f}, {2:.0f} are no degrees, in which {3} counts; assign the CRS that the data are in.</source>
        <translation>{0}: 座標({1:.0f}, {2:.0f} など)は度ではありませんが、{3} は度を単位とします。データの座標参照系を割り当ててください。</translation>
    </message>
    <message>
        <source>{0}: its longitudes and latitudes seem to be swapped ({1:.3f}, {2:.3f}); swap x and y (“Swap X and Y coordinates” in the toolbox).</source>
        <translation>{0}: 経度と緯度が入れ替わっているようです（{1:.3f}, {2:.3f}）。xとyを入れ替えてください（ツールボックスの「座標のXY入れ替え」）。</translation>
    </message>
    <message>
        <source>The points' heights are in {0}, which this release of QGIS cannot state in layers; files of city models state it.</source>
        <translation>点の高さは{0}ですが、この版のQGISではレイヤに記録できません。都市モデルのファイルには記録されます。</translation>
    </message>
    <message>
        <source>{0} does not reach {1}; give a raster of the same place.</source>
        <translation>{0}が{1}の範囲に届いていません。同じ場所のラスタを指定してください。</translation>
    </message>
    <message>
        <source>In a temporary folder, gone when QGIS ends: {0}. Give these outputs a name to keep them.</source>
        <translation>一時フォルダにあり、QGIS の終了時に消えます：{0}。残すには、これらの出力に名前を付けてください。</translation>
    </message>
    <message>
        <source>{0}: this QGIS cannot show point clouds, so no layer is loaded; the file is {1}.</source>
        <translation>{0}：この QGIS は点群を表示できないため、レイヤは読み込まれません。ファイルは {1} です。</translation>
    </message>
    <message>
        <source>not answered</source>
        <translation>未回答</translation>
    </message>
    <message>
        <source>The style {0} could not be given to {1}: {2}</source>
        <translation>スタイル{0}を{1}に適用できませんでした: {2}</translation>
    </message>
    <message>
        <source>The style {0} is not saved in {1}: {2}</source>
        <translation>スタイル{0}は{1}に保存されていません: {2}</translation>
    </message>
    <message>
        <source>{0}: {1} is neither a CSV, an SBET nor a point layer; check the file.</source>
        <translation>{0}: {1}はCSV、SBET、点レイヤのいずれでもありません。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{0} and {1} are both given: give one of them.</source>
        <translation>{0}と{1}の両方が指定されています。どちらか一方を指定してください。</translation>
    </message>
    <message>
        <source>{0}: no file was given.</source>
        <translation>{0}: ファイルが指定されていません。</translation>
    </message>
    <message>
        <source>Open a copy in the modeller…</source>
        <translation>複製をモデルデザイナーで開く…</translation>
    </message>
    <message>
        <source>UrbanMap: diagnostics</source>
        <translation>UrbanMap：診断情報</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>コピー</translation>
    </message>
    <message>
        <source>Install…</source>
        <translation>インストール…</translation>
    </message>
    <message>
        <source>Installing Python packages for UrbanMap</source>
        <translation>UrbanMap用Pythonパッケージのインストール</translation>
    </message>
    <message>
        <source>UrbanMap: Python packages</source>
        <translation>UrbanMap: Pythonパッケージ</translation>
    </message>
    <message>
        <source>Install</source>
        <translation>インストール</translation>
    </message>
    <message>
        <source>All Python packages that UrbanMap needs are there.</source>
        <translation>UrbanMapに必要なPythonパッケージはすべて揃っています。</translation>
    </message>
    <message>
        <source>The packages are installed; the algorithms can be used now.</source>
        <translation>パッケージをインストールしました。アルゴリズムを使用できます。</translation>
    </message>
    <message>
        <source>Missing: {0}. They are installed into a folder of the QGIS profile; what QGIS brought with it stays as it is.</source>
        <translation>不足: {0}。QGISプロファイルのフォルダにインストールされます。QGIS付属のものは変更されません。</translation>
    </message>
    <message>
        <source>Python packages missing: {0}.</source>
        <translation>Python パッケージがありません：{0}。</translation>
    </message>
    <message>
        <source>Still missing: {0}. Restart QGIS and look again.</source>
        <translation>まだ不足しています: {0}。QGISを再起動して再確認してください。</translation>
    </message>
    <message>
        <source>Open reports in the browser after a run</source>
        <translation>実行後に報告書をブラウザで開く</translation>
    </message>
    <message>
        <source>Open report</source>
        <translation>報告書を開く</translation>
    </message>
    <message>
        <source>The Dask scheduler was lost during the work; start it and run again.</source>
        <translation>処理中にDaskスケジューラとの接続が失われました。起動して再実行してください。</translation>
    </message>
    <message>
        <source>The Dask scheduler at {0} has no workers; start some.</source>
        <translation>{0}のDaskスケジューラにワーカーがありません。ワーカーを起動してください。</translation>
    </message>
    <message>
        <source>The cluster was lost during the work: {0} Start it and run again; tiles that are whole are kept.</source>
        <translation>処理中にクラスターとの接続が失われました：{0} クラスターを起動してから再実行してください。完成したタイルは保持されます。</translation>
    </message>
    <message>
        <source>The cluster's workers were ended at one piece again and again ({0}); give them more memory.</source>
        <translation>クラスタのワーカーが同じ処理単位で繰り返し終了しました（{0}）。メモリを増やしてください。</translation>
    </message>
    <message>
        <source>The package distributed is not there; install it (pip install distributed) to send work to {0}.</source>
        <translation>パッケージdistributedがありません。{0}に処理を送るにはインストールしてください（pip install distributed）。</translation>
    </message>
    <message>
        <source>Dask has no certificates here for {0}; name them in its configuration, distributed.comm.tls (ca-file, client.cert, client.key).</source>
        <translation>{0} に接続するための証明書が、ここの Dask の設定にありません。設定 distributed.comm.tls（ca-file、client.cert、client.key）に指定してください。</translation>
    </message>
    <message>
        <source>No Dask scheduler answers at {0} ({1}); check the address, such as tcp://host:8786.</source>
        <translation>{0}でDaskスケジューラが応答しません（{1}）。tcp://host:8786のようなアドレスを確認してください。</translation>
    </message>
    <message>
        <source>The worker {0} has another version of UrbanMap loaded; restart the workers.</source>
        <translation>ワーカー{0}には異なる版のUrbanMapが読み込まれています。ワーカーを再起動してください。</translation>
    </message>
    <message>
        <source>The worker {0} has other packages than this machine: {1}; install the same there.</source>
        <translation>ワーカー{0}のパッケージがこの計算機と異なります: {1}。同じものをインストールしてください。</translation>
    </message>
    <message>
        <source>The worker {0} does not see the folder {1}; put inputs, outputs and temporary files (TMPDIR) on storage that all machines share.</source>
        <translation>ワーカー{0}からフォルダ{1}が見えません。入力、出力、一時ファイル（TMPDIR）を全計算機の共有ストレージに置いてください。</translation>
    </message>
    <message>
        <source>numpy multiplies matrices with a slow library of QGIS ({0}), and the system does not let it use its own; results can differ in their last digits with the number of workers.</source>
        <translation>numpy の行列計算が QGIS の低速なライブラリー（{0}）で行われており、システムの制限により numpy 本来のものに切り替えられません。並列数によって結果の末尾の桁が変わることがあります。</translation>
    </message>
    <message>
        <source>result of an earlier step</source>
        <translation>前の処理の結果</translation>
    </message>
    <message>
        <source>not stated by the inputs</source>
        <translation>入力に記載なし</translation>
    </message>
    <message>
        <source>A worker ended before its work was done, for lack of memory or because Python could not start it; run again with one worker.</source>
        <translation>ワーカーが、メモリ不足またはPythonを起動できないため処理完了前に終了しました。ワーカー1つで再実行してください。</translation>
    </message>
    <message>
        <source>{0} cannot be written whole: make room on its disk, and run again.</source>
        <translation>{0}を最後まで書き込めません。ディスクの空き容量を確保して再実行してください。</translation>
    </message>
    <message>
        <source>{0} is not as it was written, by a fault of the disk or another program; run again.</source>
        <translation>{0} が書き込み時の内容と異なります（ディスクの障害または他のプログラムによる変更）。再実行してください。</translation>
    </message>
    <message>
        <source>{0} cannot be read whole; delete the folder that it is in, and run again.</source>
        <translation>{0} を最後まで読み込めません。このファイルがあるフォルダーを削除して再実行してください。</translation>
    </message>
    <message>
        <source>{0} cannot be written; check the disk.</source>
        <translation>{0} に書き込めません。ディスクを確認してください。</translation>
    </message>
    <message>
        <source>The process that worked on this tile was ended, by lack of memory or a fault in a library; make the tiles smaller.</source>
        <translation>このタイルの処理プロセスが、メモリ不足またはライブラリの不具合により終了しました。タイルを小さくしてください。</translation>
    </message>
    <message>
        <source>There are no points in this tile.</source>
        <translation>このタイルには点がありません。</translation>
    </message>
    <message>
        <source>{0} Tiles that are whole are kept.</source>
        <translation>{0} 完成したタイルは保持されます。</translation>
    </message>
    <message>
        <source>There are no outlines in this tile.</source>
        <translation>このタイルには外周線がありません。</translation>
    </message>
    <message>
        <source>{0} does not reach this tile.</source>
        <translation>{0}がこのタイルに届いていません。</translation>
    </message>
    <message>
        <source>A fault in the program: {0} in the tile's folder tells where; please report it.</source>
        <translation>プログラムの不具合です。場所はタイルのフォルダーの {0} にあります。報告をお願いします。</translation>
    </message>
    <message>
        <source>Nothing was given that says where the tiles are; give point clouds or a raster.</source>
        <translation>タイルの位置を決める入力がありません。点群またはラスタを指定してください。</translation>
    </message>
    <message>
        <source>Outlines moved without all of their neighbours</source>
        <translation>隣接する外周線の一部を欠いたまま移動された外周線</translation>
    </message>
    <message>
        <source>{0} is cut into stretches of the drive, not into meshes or sheets: leave out the grid, and give the length of a stretch as the side of a tile.</source>
        <translation>{0}はメッシュや図郭ではなく走行の区間に分割されます。グリッドの指定を外し、タイルの辺長に区間の長さを指定してください。</translation>
    </message>
    <message>
        <source>{0} are needed to run {1} over tiles; give them.</source>
        <translation>{1}のタイル処理には{0}が必要です。指定してください。</translation>
    </message>
    <message>
        <source>{0} of {1} outlines stand in rows or blocks that reach beyond the buffer: outlines nearer than {2} m are moved together, so that these can be moved otherwise than in one run; a buffer of {3} m would hold them all.</source>
        <translation>外周線 {1} 件中 {0} 件は、バッファーの外まで続く建物の列または街区の一部です。{2} m 以内にある外周線はまとめて移動されるため、一括処理とは異なる位置になることがあります。バッファーを {3} m にするとすべて収まります。</translation>
    </message>
    <message>
        <source>Settings: “{0}” is no line NAME=VALUE with a parameter of {1}; it has {2}.</source>
        <translation>設定: 「{0}」は{1}のパラメータのNAME=VALUE形式の行ではありません。使用できるもの: {2}。</translation>
    </message>
    <message>
        <source>Settings: {0} is a parameter of the run itself; give it there.</source>
        <translation>設定: {0}は実行自体のパラメータです。そちらで指定してください。</translation>
    </message>
    <message>
        <source>{0} ({1}) must be given over tiles, because each tile would choose for itself.</source>
        <translation>タイル処理では{0}（{1}）の指定が必要です。指定しないとタイルごとに異なる値が選ばれます。</translation>
    </message>
    <message>
        <source>{0} cannot be made tile by tile; make it of the merged layers.</source>
        <translation>{0}はタイルごとに作成できません。結合後のレイヤから作成してください。</translation>
    </message>
    <message>
        <source>{0} is sorted into tiles.</source>
        <translation>{0}をタイルに振り分けています。</translation>
    </message>
    <message>
        <source>No wall was moved: the observations do not decide; the field “reason” of the walls tells why.</source>
        <translation>移動した壁面はありません。観測値では判定できません。理由は壁面のフィールド「reason」を参照してください。</translation>
    </message>
    <message>
        <source>{0} of {1} walls were adjusted, {2} more are likely.</source>
        <translation>{1}枚の壁のうち{0}枚を調整し、ほかに{2}枚は推定です。</translation>
    </message>
    <message>
        <source>{0} observations left out: {1}</source>
        <translation>観測値{0}件を除外: {1}</translation>
    </message>
    <message>
        <source>{0}: the layer has no field {1}.</source>
        <translation>{0}: レイヤにフィールド{1}がありません。</translation>
    </message>
    <message>
        <source>{0}: give three numbers, such as 0.5, 0, -1.8.</source>
        <translation>{0}: 0.5, 0, -1.8のように3つの数値を指定してください。</translation>
    </message>
    <message>
        <source>Give a trajectory, or a time for an area.</source>
        <translation>軌跡を指定するか、範囲に対する時刻を指定してください。</translation>
    </message>
    <message>
        <source>{0}: a raster is made of an area only; leave out the trajectory or it.</source>
        <translation>{0}: ラスタは範囲に対してのみ作成されます。軌跡かラスタのどちらかの指定を外してください。</translation>
    </message>
    <message>
        <source>{0} of {1} places lie inside buildings and have no number.</source>
        <translation>地点{1}か所中{0}か所は建物内のため数値がありません。</translation>
    </message>
    <message>
        <source>None of the {0} facades is seen in an image, so that there is no result: check that building models, trajectory and images are of one place.</source>
        <translation>壁面{0}件のいずれも画像に写っていないため、結果がありません。建物モデル、軌跡、画像が同じ場所のものか確認してください。</translation>
    </message>
    <message>
        <source>{0} of {1} facades have no texture; the field “reason” of the layer of facades tells why.</source>
        <translation>壁面{1}件中{0}件にテクスチャがありません。理由は壁面レイヤのフィールド「reason」を参照してください。</translation>
    </message>
    <message>
        <source>The coordinate reference system is not known: the point cloud is written without one.</source>
        <translation>座標参照系が不明です。点群は座標参照系なしで書き出されます。</translation>
    </message>
    <message>
        <source>Scanner {0}: {1} points</source>
        <translation>スキャナ{0}: {1}点</translation>
    </message>
    <message>
        <source>{0} returns were measured outside the trajectory or in a gap of it and are left out.</source>
        <translation>反射信号{0}件は、軌跡の範囲外または欠測区間で計測されたため除外しました。</translation>
    </message>
    <message>
        <source>No image was given; give line images, frames or an orthophoto.</source>
        <translation>画像が指定されていません。ライン画像、空中写真、オルソ画像のいずれかを指定してください。</translation>
    </message>
    <message>
        <source>No image was given; give line images or frames.</source>
        <translation>画像が指定されていません。ライン画像または空中写真を指定してください。</translation>
    </message>
    <message>
        <source>{0}: is needed for these images; give it.</source>
        <translation>{0}: これらの画像に必要です。指定してください。</translation>
    </message>
    <message>
        <source>{0} of {1} outlines could not be measured; the field “reason” tells why.</source>
        <translation>外周線{1}件中{0}件は計測できませんでした。理由はフィールド「reason」を参照してください。</translation>
    </message>
    <message>
        <source>There is nothing to draw; give laser points, or models or lines.</source>
        <translation>描画するものがありません。レーザ点群、モデル、線のいずれかを指定してください。</translation>
    </message>
    <message>
        <source>Nothing lies in {0} of {1} images: {2}.</source>
        <translation>画像{1}枚中{0}枚には何も写りません: {2}。</translation>
    </message>
    <message>
        <source>{0} was given, but not {1}; give both.</source>
        <translation>{0}が指定されていますが、{1}がありません。両方を指定してください。</translation>
    </message>
    <message>
        <source>The tie points have neither columns x_mms,y_mms,x_ref,y_ref nor lines from survey to reference.</source>
        <translation>タイポイントに列x_mms,y_mms,x_ref,y_refがなく、計測から基準への線もありません。</translation>
    </message>
    <message>
        <source>The height of the origin above the ground was not given: the mean height stays as reported ({0:.2f} m above the ground).</source>
        <translation>原点の地上高が指定されていません。平均の高さは補正前のままです（地上{0:.2f} m）。</translation>
    </message>
    <message>
        <source>{0}: {1} would be written over another trajectory; choose another folder.</source>
        <translation>{0}: {1}が別の軌跡を上書きします。別のフォルダを選択してください。</translation>
    </message>
    <message>
        <source>Corrected image poses are wanted, but no image poses are given.</source>
        <translation>補正後の画像の位置姿勢が求められていますが、画像の位置姿勢が指定されていません。</translation>
    </message>
    <message>
        <source>{0}: {1} is neither a raster nor a polygon layer; check the file.</source>
        <translation>{0}: {1}はラスタでもポリゴンレイヤでもありません。ファイルを確認してください。</translation>
    </message>
    <message>
        <source>{0}: {1} is neither a raster nor a polygon layer; choose another one.</source>
        <translation>{0}: {1}はラスタでもポリゴンレイヤでもありません。別のものを選択してください。</translation>
    </message>
    <message>
        <source>The paper's method knows no walls: the buildings are not used.</source>
        <translation>論文の方法は壁面を使いません。建物は使われません。</translation>
    </message>
    <message>
        <source>{0}: the paper's method knows no walls; choose paint, or the full method.</source>
        <translation>{0}：論文の方法は壁面を使いません。paint を選ぶか、full の方法にしてください。</translation>
    </message>
    <message>
        <source>{0} and {1}: the survey is laid on one of them beside the markings; give one of both.</source>
        <translation>{0} と {1}：路面標示のほかに MMS計測を重ねる対象はどちらか一方です。一方だけを指定してください。</translation>
    </message>
    <message>
        <source>{0}: walls alone need buildings; give outlines or models of them.</source>
        <translation>{0}：壁面だけで位置合わせするには建物が必要です。外形線またはモデルを指定してください。</translation>
    </message>
    <message>
        <source>Guide</source>
        <translation>ガイド</translation>
    </message>
    <message>
        <source>UrbanMap: from your files to results</source>
        <translation>UrbanMap：手元のファイルから成果まで</translation>
    </message>
    <message>
        <source>Open a chain in the modeller</source>
        <translation>処理の流れをモデルデザイナーで開く</translation>
    </message>
    <message>
        <source>Sample city…</source>
        <translation>サンプル都市…</translation>
    </message>
    <message>
        <source>Documentation</source>
        <translation>ドキュメント</translation>
    </message>
    <message>
        <source>Install Python packages…</source>
        <translation>Pythonパッケージのインストール…</translation>
    </message>
    <message>
        <source>Diagnostics…</source>
        <translation>診断情報…</translation>
    </message>
    <message>
        <source>The model {0} cannot be loaded.</source>
        <translation>モデル{0}を読み込めません。</translation>
    </message>
    <message>
        <source>The module {0} cannot be loaded:</source>
        <translation>モジュール{0}を読み込めません:</translation>
    </message>
    <message>
        <source>old map</source>
        <translation>旧地図</translation>
    </message>
    <message>
        <source>new map</source>
        <translation>新地図</translation>
    </message>
    <message>
        <source>{0} has no field class; give marking lines or bounds of lanes.</source>
        <translation>{0} に属性 class がありません。標示の線または車線の境界線を指定してください。</translation>
    </message>
    <message>
        <source>{0} has no field class; give the areas of “Lines from road markings”.</source>
        <translation>{0} に属性 class がありません。「路面標示から線」の面を指定してください。</translation>
    </message>
    <message>
        <source>{0}: an area goes with maps of which one is given as lines.</source>
        <translation>{0}：範囲は、少なくとも一方の地図を線で与えたときに使えます。</translation>
    </message>
    <message>
        <source>Give the {0} either as Lanelet2 file or as lines.</source>
        <translation>{0}を Lanelet2 ファイルまたは線のどちらか一方で指定してください。</translation>
    </message>
    <message>
        <source>{0}: areas go with a map that is given as lines.</source>
        <translation>{0}：面は、線で与えた地図とともに使います。</translation>
    </message>
    <message>
        <source>stated by both maps</source>
        <translation>両方の地図に記載</translation>
    </message>
    <message>
        <source>given</source>
        <translation>指定</translation>
    </message>
    <message>
        <source>estimated from what did not change</source>
        <translation>変化のない要素から推定</translation>
    </message>
    <message>
        <source>too few of the kind: taken from all stop lines, crosswalks and symbols, or from lines</source>
        <translation>この種類は数が足りないため、すべての停止線・横断歩道・記号、または線から推定</translation>
    </message>
    <message>
        <source>not known: too few lines, and no map states it; no shift is told</source>
        <translation>不明：線が少なく、地図にも記載がないため、移動は判定しない</translation>
    </message>
    <message>
        <source>Offset to the east (m)</source>
        <translation>東方向のずれ (m)</translation>
    </message>
    <message>
        <source>Its sigma (m)</source>
        <translation>その標準偏差 (m)</translation>
    </message>
    <message>
        <source>Offset to the north (m)</source>
        <translation>北方向のずれ (m)</translation>
    </message>
    <message>
        <source>Sigma of that (m)</source>
        <translation>その標準偏差 (m)</translation>
    </message>
    <message>
        <source>Offset significant</source>
        <translation>ずれは有意か</translation>
    </message>
    <message>
        <source>Compared lines of the old map (m)</source>
        <translation>比較した旧地図の線 (m)</translation>
    </message>
    <message>
        <source>Of it as they were (m)</source>
        <translation>うち変化なし (m)</translation>
    </message>
    <message>
        <source>Of it not known (m)</source>
        <translation>そのうち不明(m)</translation>
    </message>
    <message>
        <source>Lines of the old map where the new one shows no road, not judged (m)</source>
        <translation>新地図に道路が載っていない旧地図の線（判定せず） (m)</translation>
    </message>
    <message>
        <source>Lines of the new map where the old one shows no road, not judged (m)</source>
        <translation>旧地図に道路が載っていない新地図の線（判定せず） (m)</translation>
    </message>
    <message>
        <source>Changes by kind</source>
        <translation>種類ごとの変化</translation>
    </message>
    <message>
        <source>Sigma of places</source>
        <translation>位置の標準偏差</translation>
    </message>
    <message>
        <source>A shift is told where it exceeds the limit, in sigmas of both maps together: 3, more where sigma was estimated from few. Sigmas that the maps state are multiplied by the factor.</source>
        <translation>移動は、両方の地図を合わせた標準偏差の限界倍を超えたときに示します（3 倍。少数から推定したときはそれ以上）。地図に記載の標準偏差には係数を掛けます。</translation>
    </message>
    <message>
        <source>Map</source>
        <translation>地図</translation>
    </message>
    <message>
        <source>The old map pale, the new one dark; moved orange, added green, removed red, repainted blue, with the numbers of the list.</source>
        <translation>旧地図は淡色、新地図は濃色。移動は橙、追加は緑、撤去は赤、塗り替えは青。番号は一覧のもの。</translation>
    </message>
    <message>
        <source>List of changes</source>
        <translation>変化の一覧</translation>
    </message>
    <message>
        <source>{0:.1%} of {1:.0f} m of lines are the same within three sigma; {2} changes are listed below.</source>
        <translation>線 {1:.0f} m の {0:.1%} は標準偏差の 3 倍以内で同じです。{2} 件の変化を下に示します。</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>種類</translation>
    </message>
    <message>
        <source>Length (m)</source>
        <translation>長さ (m)</translation>
    </message>
    <message>
        <source>Median shift (m)</source>
        <translation>移動量の中央値 (m)</translation>
    </message>
    <message>
        <source>From</source>
        <translation>出典</translation>
    </message>
    <message>
        <source>Old map (m)</source>
        <translation>旧地図 (m)</translation>
    </message>
    <message>
        <source>New map (m)</source>
        <translation>新地図 (m)</translation>
    </message>
    <message>
        <source>Factor</source>
        <translation>係数</translation>
    </message>
    <message>
        <source>Limit (sigmas)</source>
        <translation>限界（標準偏差の倍数）</translation>
    </message>
    <message>
        <source>Compared</source>
        <translation>比較数</translation>
    </message>
    <message>
        <source>No.</source>
        <translation>番号</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>変化前</translation>
    </message>
    <message>
        <source>After</source>
        <translation>変化後</translation>
    </message>
    <message>
        <source>Shift (m)</source>
        <translation>移動量 (m)</translation>
    </message>
    <message>
        <source>Along (m)</source>
        <translation>縦方向 (m)</translation>
    </message>
    <message>
        <source>Across (m)</source>
        <translation>横方向 (m)</translation>
    </message>
    <message>
        <source>Sigma (m)</source>
        <translation>標準偏差 (m)</translation>
    </message>
    <message>
        <source>Shift over sigma</source>
        <translation>移動量÷標準偏差</translation>
    </message>
    <message>
        <source>Old id</source>
        <translation>旧 id</translation>
    </message>
    <message>
        <source>New id</source>
        <translation>新 id</translation>
    </message>
    <message>
        <source>whole map</source>
        <translation>地図全体</translation>
    </message>
    <message>
        <source>The whole new map lies {0:+.3f} m to the east and {1:+.3f} m to the north of the old one, which was taken off first: look which of them is right.</source>
        <translation>新地図は全体として旧地図から東へ {0:+.3f} m、北へ {1:+.3f} m ずれています。比較の前に除きました。どちらが正しいか確認してください。</translation>
    </message>
    <message>
        <source>Of {0:.0f} m it is not known whether they moved: the maps are not accurate enough.</source>
        <translation>{0:.0f} m については、地図の精度が足りないため、移動したかどうか分かりません。</translation>
    </message>
    <message>
        <source>What did not change scatters {0:.1f} times as much as the maps' sigmas say: they were multiplied by it. Look whether one of the maps is placed worse than it states.</source>
        <translation>変化のない要素のばらつきは、地図に記載の標準偏差の {0:.1f} 倍です。標準偏差にこれを掛けました。どちらかの地図の位置が記載より悪くないか確認してください。</translation>
    </message>
    <message>
        <source>In both maps: {0}</source>
        <translation>両方の地図にある：{0}</translation>
    </message>
    <message>
        <source>Place {0}, about {1:.0f}, {2:.0f}.</source>
        <translation>場所 {0}（{1:.0f}, {2:.0f} 付近）。</translation>
    </message>
    <message>
        <source>The first {0} of {1} are shown; the layer holds all.</source>
        <translation>{1} 件のうち最初の {0} 件を示します。全件はレイヤにあります。</translation>
    </message>
    <message>
        <source>{0} has no field kind; give the points of “Street objects”.</source>
        <translation>{0} にフィールド kind がありません。「道路沿いの地物」の点を指定してください。</translation>
    </message>
    <message>
        <source>{0}: no building has a height; give solids or outlines with heights.</source>
        <translation>{0}: 高さを持つ建物がありません。立体または高さ付きの外周線を指定してください。</translation>
    </message>
    <message>
        <source>{0}: no feature has an edge; give polygons or lines of markings.</source>
        <translation>{0}: 辺を持つ地物がありません。路面標示のポリゴンまたは線を指定してください。</translation>
    </message>
    <message>
        <source>{0} has no field sigma; give walls whose accuracy was measured.</source>
        <translation>{0}にフィールドsigmaがありません。精度が計測された壁面を指定してください。</translation>
    </message>
    <message>
        <source>Give buildings, markings or both: there is no map without them.</source>
        <translation>建物、路面標示、またはその両方を指定してください。これらがないと地図を作成できません。</translation>
    </message>
    <message>
        <source>Give roads or trajectories, not both.</source>
        <translation>道路か軌跡のどちらか一方を指定してください。</translation>
    </message>
    <message>
        <source>Nothing can be said of any place: see the field status.</source>
        <translation>どの地点についても判定できません。フィールドstatusを参照してください。</translation>
    </message>
    <message>
        <source>Nothing was simulated: no building has a height.</source>
        <translation>シミュレーションを行いませんでした。高さを持つ建物がありません。</translation>
    </message>
    <message>
        <source>{0}: satellites need buildings that hide them; give these too.</source>
        <translation>{0}: 衛星の計算には遮蔽する建物が必要です。建物も指定してください。</translation>
    </message>
    <message>
        <source>{0}: scans are simulated of buildings; give these.</source>
        <translation>{0}: スキャンのシミュレーションには建物が必要です。指定してください。</translation>
    </message>
    <message>
        <source>{0}: {1} of {2} features have no heights and are left out; give the field with the height of their tops.</source>
        <translation>{0}: 地物{2}件中{1}件に高さがなく、除外しました。上端の高さのフィールドを指定してください。</translation>
    </message>
    <message>
        <source>Length of lanes (m)</source>
        <translation>車線の長さ (m)</translation>
    </message>
    <message>
        <source>Bounds seen, share</source>
        <translation>計測された境界線の割合</translation>
    </message>
    <message>
        <source>Median sigma of bounds (m)</source>
        <translation>境界線のσの中央値 (m)</translation>
    </message>
    <message>
        <source>Driven near the map (m)</source>
        <translation>地図付近の走行距離 (m)</translation>
    </message>
    <message>
        <source>Of it inside lanes, share</source>
        <translation>うち車線内の割合</translation>
    </message>
    <message>
        <source>Lanes pale, ways through junctions red, arrows with the traffic; drives dotted, findings numbered. Look for arrows against the traffic, and for strips of road without a lane.</source>
        <translation>車線は淡色、交差点内の通行路は赤、矢印は通行方向。走行は点線、指摘は番号付きです。逆向きの矢印と、車線のない道路部分を探してください。</translation>
    </message>
    <message>
        <source>No lane was made: nothing shows the direction of any strip between lines.</source>
        <translation>車線は作成されませんでした。線の間の帯の方向を示すものがありません。</translation>
    </message>
    <message>
        <source>No trajectory was given: only paint and road axes tell directions, and nothing leads through junctions.</source>
        <translation>軌跡が指定されていません。方向は路面標示と道路中心線だけから判定され、交差点内の経路はありません。</translation>
    </message>
    <message>
        <source>left</source>
        <translation>左</translation>
    </message>
    <message>
        <source>not shown by drives; left assumed</source>
        <translation>走行なし（左側通行と仮定）</translation>
    </message>
    <message>
        <source>no lane made</source>
        <translation>車線の作成なし</translation>
    </message>
    <message>
        <source>What is missing or contradicts is numbered in the map and listed below: {0} findings.</source>
        <translation>不足や矛盾には地図上で番号を付け、下に一覧を示します：指摘 {0} 件。</translation>
    </message>
    <message>
        <source>{0:.0%} of the length of the bounds was not seen and is drawn through gaps; see the findings “bound not seen”.</source>
        <translation>境界線の長さの{0:.0%}は計測されておらず、欠落部を通して描かれています。指摘「境界線の未計測」を参照してください。</translation>
    </message>
    <message>
        <source>Of {0} strips beside lines no lane was made; see the findings “{1}”.</source>
        <translation>線の間の帯 {0} 本には車線を作成していません。指摘「{1}」を参照してください。</translation>
    </message>
    <message>
        <source>Evidence on directions contradicts itself at {0} places.</source>
        <translation>方向の根拠が{0}か所で矛盾しています。</translation>
    </message>
    <message>
        <source>Direction from: {0} (m)</source>
        <translation>方向の根拠: {0} (m)</translation>
    </message>
    <message>
        <source>Junction {0}, about {1:.0f}, {2:.0f}: each way that may be driven should be drawn red.</source>
        <translation>交差点 {0}、およそ {1:.0f}、{2:.0f}：通行できる経路はすべて赤で描かれているはずです。</translation>
    </message>
    <message>
        <source>{0} lanes of {1:.0f} m together, and {2} ways through junctions that were driven.</source>
        <translation>車線{0}本（延長{1:.0f} m）、走行された交差点内の経路{2}本。</translation>
    </message>
    <message>
        <source>The map is not connected along the drives at {0} places; see the findings “driven without lane” and “way not drawn”.</source>
        <translation>地図は走行に沿って{0}か所で接続されていません。指摘「車線のない走行」と「経路の未描画」を参照してください。</translation>
    </message>
    <message>
        <source>Neither road markings nor marking points were given: give one or both.</source>
        <translation>路面標示も路面標示点も与えられていません。一方または両方を指定してください。</translation>
    </message>
    <message>
        <source>No lines.</source>
        <translation>線がありません。</translation>
    </message>
    <message>
        <source>Marking points add {0} pieces of paint, {1} m².</source>
        <translation>路面標示点により標示 {0} 片、{1} m² が加わりました。</translation>
    </message>
    <message>
        <source>{0} has no value at any line: check that it is of the same place as the markings.</source>
        <translation>{0}にはどの線の位置にも値がありません。標示と同じ場所のものか確認してください。</translation>
    </message>
    <message>
        <source>{0} has no value at {1} % of the lines' places: they stay without heights.</source>
        <translation>{0}には線の位置の{1} %で値がありません。そこは高さなしのままになります。</translation>
    </message>
    <message>
        <source>No line was found in the {0} polygons: check that they are road markings in metres, and lower the minimum line length for short ones.</source>
        <translation>ポリゴン{0}件から線が見つかりませんでした。メートル単位の路面標示であることを確認し、短い線の場合は最小線長を小さくしてください。</translation>
    </message>
    <message>
        <source>Objects by kind</source>
        <translation>種類別の地物</translation>
    </message>
    <message>
        <source>The path grey; poles black, lamp posts yellow, signals red, signs blue, trees green, bollards brown, boxes violet; doubtful objects hollow.</source>
        <translation>経路は灰色。柱は黒、街灯は黄、信号は赤、標識は青、樹木は緑、車止めは茶、箱状の物は紫。疑わしい物は中抜き。</translation>
    </message>
    <message>
        <source>Doubtful</source>
        <translation>不確か</translation>
    </message>
    <message>
        <source>Median height (m)</source>
        <translation>高さの中央値 (m)</translation>
    </message>
    <message>
        <source>Median diameter (m)</source>
        <translation>直径の中央値 (m)</translation>
    </message>
    <message>
        <source>Median sigma (m)</source>
        <translation>標準偏差の中央値 (m)</translation>
    </message>
    <message>
        <source>No object was found along {0:.0f} m.</source>
        <translation>{0:.0f} m の区間に地物は見つかりませんでした。</translation>
    </message>
    <message>
        <source>{0} objects along {1:.0f} m; {2} of them are doubtful.</source>
        <translation>{1:.0f} m の区間に地物 {0} 個、うち不確かなもの {2} 個。</translation>
    </message>
    <message>
        <source>Areas by kind</source>
        <translation>種類別の区分面</translation>
    </message>
    <message>
        <source>Surfaces by kind</source>
        <translation>種類別の面</translation>
    </message>
    <message>
        <source>Roads grey, junctions orange, bridges blue, tunnels violet; middle lines dashed, findings numbered.</source>
        <translation>灰色は道路、橙は交差部、青は橋梁、紫はトンネル。破線は中心線、番号は指摘事項。</translation>
    </message>
    <message>
        <source>No surface was made.</source>
        <translation>面は作成されませんでした。</translation>
    </message>
    <message>
        <source>Area (m²)</source>
        <translation>面積 (m²)</translation>
    </message>
    <message>
        <source>Carriageways grey, lanes blue, junctions orange, sidewalks green, islands dark green; steps red, findings numbered.</source>
        <translation>車道部は灰色、車線は青、交差部は橙、歩道部は緑、島は濃い緑。段差は赤、指摘は番号。</translation>
    </message>
    <message>
        <source>Surfaces to look at</source>
        <translation>要確認の面</translation>
    </message>
    <message>
        <source>LOD{0}: {1} sections and {2} junctions in {3} areas; borders doubtful or not seen all along: {4} areas; findings: {5}.</source>
        <translation>LOD{0}：単路部 {1}、交差部 {2}、区分面 {3}。境界の一部が不確かか見えなかった区分面：{4}。指摘事項：{5} 件。</translation>
    </message>
    <message>
        <source>{0} surfaces, {1} of them junctions; to be looked at: {2} surfaces; findings: {3}.</source>
        <translation>面 {0} 個、うち交差部 {1} 個。要確認の面：{2} 個、指摘事項：{3} 件。</translation>
    </message>
    <message>
        <source>No road model was made. {0}</source>
        <translation>道路モデルは作成されませんでした。{0}</translation>
    </message>
    <message>
        <source>Only {0:.0%} of the borders were measured: the rest is drawn on, doubtful or given. Snow, parked vehicles or a scanner too far away may hide the kerbs.</source>
        <translation>計測できた境界は {0:.0%} だけです。残りは延長・要確認・既存の縁です。積雪、駐車車両、遠すぎるスキャナーなどで縁石が隠れた可能性があります。</translation>
    </message>
    <message>
        <source>Junction {0}, about {1:.0f}, {2:.0f}: look whether it is cut where the stop lines are.</source>
        <translation>交差部 {0}（{1:.0f}, {2:.0f} 付近）：停止線の位置で区切られているか確認してください。</translation>
    </message>
    <message>
        <source>Surface {0}, about {1:.0f}, {2:.0f}.</source>
        <translation>面 {0}（{1:.0f}, {2:.0f} 付近）</translation>
    </message>
    <message>
        <source>{0} is given but {1} is not: name the GeoPackage that it is to go into.</source>
        <translation>{0}が指定されていますが、{1}がありません。書き込み先のGeoPackageを指定してください。</translation>
    </message>
    <message>
        <source>{0}, {1}: {2}</source>
        <translation>{0}、{1}: {2}</translation>
    </message>
    <message>
        <source>No kerb was found along {0:.0f} m of path: the road has none, or the points are too sparse or too noisy to show steps of a few centimetres.</source>
        <translation>軌跡{0:.0f} mに沿って縁石が見つかりませんでした。道路に縁石がないか、点が疎またはノイズが大きく、数cmの段差を判別できません。</translation>
    </message>
    <message>
        <source>No kerb was found beside {0:.0f} m of the path on the left and {1:.0f} m on the right.</source>
        <translation>走行経路の左側{0:.0f} m、右側{1:.0f} mで縁石が見つかりませんでした。</translation>
    </message>
    <message>
        <source>Steps lower than {0:.1f} cm do not show surely in this survey, by the number and the scatter of its points on the ground and the lowest kerb asked for, {1:.1f} cm: there may be lower kerbs.</source>
        <translation>地面の点の数とばらつき、および指定した最低の縁石（{1:.1f} cm）から、この計測では{0:.1f} cmより低い段差は確実には現れません。それより低い縁石があるかもしれません。</translation>
    </message>
    <message>
        <source>{0} is not given: it is what this level of detail is made of.</source>
        <translation>{0} が指定されていません。この詳細度はそれから作ります。</translation>
    </message>
    <message>
        <source>{0} objects along {1:.0f} m.</source>
        <translation>{1:.0f} m の区間に地物 {0} 個。</translation>
    </message>
    <message>
        <source>{0} is not given: CityGML then has no creationDate, which PLATEAU asks for.</source>
        <translation>{0}が指定されていません。CityGML に PLATEAU が必須とする creationDate が入りません。</translation>
    </message>
    <message>
        <source>{0}: {1}</source>
        <translation>{0}：{1}</translation>
    </message>
    <message>
        <source>{0} objects are doubtful: {1}.</source>
        <translation>地物 {0} 個は不確かです: {1}。</translation>
    </message>
    <message>
        <source>{0} has no field edge_id; give the upper edges of “Road edges”.</source>
        <translation>{0} に属性 edge_id がありません。「道路縁」の上端線を指定してください。</translation>
    </message>
    <message>
        <source>Without trajectories only arrows and stop lines tell directions: most strips stay findings, and ways through junctions are inferred.</source>
        <translation>軌跡がないと、方向は矢印と停止線だけから判断します。多くの帯は指摘事項のまま残り、交差点内の進路は推定によります。</translation>
    </message>
    <message>
        <source>There are no marking lines: no lane can be made.</source>
        <translation>標示の線がありません。車線は作れません。</translation>
    </message>
    <message>
        <source>No lane was made: the drives run beside all lines; check that both are of one place, in one CRS, and that the trajectories are corrected.</source>
        <translation>車線は作成されませんでした。走行がすべての線から外れています。両者が同じ場所・同じ座標参照系で、軌跡が補正済みであることを確認してください。</translation>
    </message>
    <message>
        <source>{0} has no field class; give the lines of “Lines from road markings”.</source>
        <translation>{0}にフィールドclassがありません。「路面標示からの線」の線を指定してください。</translation>
    </message>
    <message>
        <source>{0}: none of the {1} features has a line; choose a line layer.</source>
        <translation>{0}：{1}個の地物のどれにも線がありません。ラインレイヤを選んでください。</translation>
    </message>
    <message>
        <source>{0}: the field class holds none of the words {1}; give the lines of “Lines from road markings”, or write these words.</source>
        <translation>{0}：フィールドclassに{1}のどの語もありません。「路面標示からの線」の線を与えるか、これらの語を書いてください。</translation>
    </message>
    <message>
        <source>{0} has no fields class and heading; give the areas of “Lines from road markings”.</source>
        <translation>{0}にフィールドclassとheadingがありません。「路面標示からの線」の面を指定してください。</translation>
    </message>
    <message>
        <source>No folder was given: give the name of a new one.</source>
        <translation>フォルダが指定されていません。新しいフォルダ名を指定してください。</translation>
    </message>
    <message>
        <source>Frames used: {0}; holes that no frame sees outside buildings: {1:.0f} m².</source>
        <translation>使用した空中写真: {0}枚。建物以外でどの写真にも写らない欠落: {1:.0f} m²。</translation>
    </message>
    <message>
        <source>{0}: give also a folder, so that the results of the job's own inputs stay.</source>
        <translation>{0}：作業本来の入力の結果を残すため、フォルダも指定してください。</translation>
    </message>
    <message>
        <source>{0}: “{1}” is no line ROLE=FILE.</source>
        <translation>{0}：「{1}」は「役割=ファイル」の行ではありません。</translation>
    </message>
    <message>
        <source>{0}: done before, with the same inputs and settings; left alone.</source>
        <translation>{0}：同じ入力と設定で完了しているため、そのまま残しました。</translation>
    </message>
    <message>
        <source>{0} of {1} tiles failed; all others are in {2}. Put right what the warnings and the layer of tiles say, and run again with the same folder: only these tiles are then done.</source>
        <translation>{1} タイル中 {0} タイルが失敗しました。その他のタイルの結果は {2} にあります。警告とタイルのレイヤーに示された原因を取り除き、同じフォルダーで再実行してください。失敗したタイルだけが処理されます。</translation>
    </message>
    <message>
        <source>{0} tiles, {1} kept from an earlier run, {2} to do.</source>
        <translation>{0}タイル: 以前の実行から保持{1}、未処理{2}。</translation>
    </message>
    <message>
        <source>{0}, tile by tile</source>
        <translation>{0}（タイルごと）</translation>
    </message>
    <message>
        <source>{0} cannot be run over tiles: {1}.</source>
        <translation>{0}はタイル処理できません: {1}。</translation>
    </message>
    <message>
        <source>All {0} tiles are empty; check that the inputs lie in one place.</source>
        <translation>全{0}タイルが空です。入力が同じ場所にあるか確認してください。</translation>
    </message>
    <message>
        <source>Tile {0} failed: {1}</source>
        <translation>タイル{0}が失敗しました: {1}</translation>
    </message>
    <message>
        <source>{0} outlines lie where no tile has a result; the merged layer has a row for each, with the reason.</source>
        <translation>{0} 棟の外周は結果のあるタイルにありません。結合したレイヤーに、それぞれの行を理由とともに入れました。</translation>
    </message>
    <message>
        <source>Acceptance: errors at check points</source>
        <translation>精度管理表：検証点の較差</translation>
    </message>
    <message>
        <source>The standard deviation is that about a mean of 0, the root of the mean square: what all points share counts too. With a confidence of 95 % the standard deviation of all places is below the upper bound, if errors are normal.</source>
        <translation>標準偏差は母平均を0とした値（二乗平均平方根）で、全点に共通する誤差も含みます。誤差が正規分布に従う場合、95 %の信頼度で標準偏差は上限値以下です。</translation>
    </message>
    <message>
        <source>Sampled edges of buildings</source>
        <translation>建物の抽出辺</translation>
    </message>
    <message>
        <source>Edges were drawn at random in each unit, and both ends of each surveyed. An edge with one end counts among the points, but not among the edges.</source>
        <translation>辺は検査単位ごとに無作為に抽出し、その両端を点検測量したものです。一端だけの辺は、点の数には入りますが辺の数には入りません。</translation>
    </message>
    <message>
        <source>Where the drawn edges lie, with their numbers.</source>
        <translation>抽出した辺の位置と番号です。</translation>
    </message>
    <message>
        <source>Figures</source>
        <translation>較差の統計</translation>
    </message>
    <message>
        <source>Registration</source>
        <translation>位置合わせ</translation>
    </message>
    <message>
        <source>All check points</source>
        <translation>検証点一覧</translation>
    </message>
    <message>
        <source>Units with fewer edges than needed cannot be judged by themselves: choose others, or larger ones.</source>
        <translation>辺の数が足りない検査単位は、単独では判定できません。別の、またはより大きな検査単位を選んでください。</translation>
    </message>
    <message>
        <source>These are the errors as reported: the layer has none after a correction.</source>
        <translation>補正前の較差です。レイヤに補正後の値がありません。</translation>
    </message>
    <message>
        <source>Where the errors lie</source>
        <translation>較差の分布</translation>
    </message>
    <message>
        <source>All drawn edges</source>
        <translation>抽出したすべての辺</translation>
    </message>
    <message>
        <source>Edges in the points</source>
        <translation>点群に現れた辺の数</translation>
    </message>
    <message>
        <source>Road markings from the air</source>
        <translation>空中写真からの路面標示</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>結果</translation>
    </message>
    <message>
        <source>of these white</source>
        <translation>うち白</translation>
    </message>
    <message>
        <source>of these yellow</source>
        <translation>うち黄</translation>
    </message>
    <message>
        <source>Marked area (m²)</source>
        <translation>標示の面積 (m²)</translation>
    </message>
    <message>
        <source>Searched area (m²)</source>
        <translation>探索面積 (m²)</translation>
    </message>
    <message>
        <source>Marked share of it</source>
        <translation>うち標示の割合</translation>
    </message>
    <message>
        <source>Pixel (m)</source>
        <translation>画素 (m)</translation>
    </message>
    <message>
        <source>Median width (m)</source>
        <translation>幅の中央値 (m)</translation>
    </message>
    <message>
        <source>Total length of strokes (m)</source>
        <translation>線の総延長 (m)</translation>
    </message>
    <message>
        <source>The image's own road</source>
        <translation>画像から求めた道路面</translation>
    </message>
    <message>
        <source>Smooth grey ground in the light. All brightness, colour and roughness is judged relative to it.</source>
        <translation>日なたの滑らかな灰色の地面。明るさ・色・粗さはすべてこれを基準に判断する。</translation>
    </message>
    <message>
        <source>Texture (grey values)</source>
        <translation>テクスチャ（階調値）</translation>
    </message>
    <message>
        <source>Warmth (share of the brightness)</source>
        <translation>暖色度（明るさに対する比）</translation>
    </message>
    <message>
        <source>Brightness (grey values)</source>
        <translation>明るさ（階調値）</translation>
    </message>
    <message>
        <source>What was taken and rejected</source>
        <translation>採用したものと除いたもの</translation>
    </message>
    <message>
        <source>Bright and narrow (share of the image)</source>
        <translation>明るく細いもの（画像に占める割合）</translation>
    </message>
    <message>
        <source>of these taken for paint</source>
        <translation>うち標示としたもの</translation>
    </message>
    <message>
        <source>Shifts between overlapping frames</source>
        <translation>重複する空中写真間のずれ</translation>
    </message>
    <message>
        <source>The same markings in two frames, the second against the first, median over the places. A good block agrees to half a pixel. “height”: without a surface, heights may explain the shift.</source>
        <translation>2枚の写真に写る同じ標示の、1枚目に対する2枚目のずれ（各箇所の中央値）です。良好なブロックでは半画素以内で一致します。「高さ」: 表層モデルがないと、高さがずれの原因となり得ます。</translation>
    </message>
    <message>
        <source>first</source>
        <translation>1枚目</translation>
    </message>
    <message>
        <source>second</source>
        <translation>2枚目</translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation>写真</translation>
    </message>
    <message>
        <source>What to distrust</source>
        <translation>注意すべき点</translation>
    </message>
    <message>
        <source>Figures of the markings</source>
        <translation>標示の数値</translation>
    </message>
    <message>
        <source>Markings by width</source>
        <translation>幅別の標示</translation>
    </message>
    <message>
        <source>grey values above the road</source>
        <translation>路面に対する濃淡値の差</translation>
    </message>
    <message>
        <source>Markings by contrast</source>
        <translation>コントラスト別の標示</translation>
    </message>
    <message>
        <source>Share of the found area that is paint, by its confidence</source>
        <translation>抽出面積のうち標示の割合（信頼度による）</translation>
    </message>
    <message>
        <source>Share of the paint that was found, by its confidence</source>
        <translation>標示のうち抽出された割合（信頼度による）</translation>
    </message>
    <message>
        <source>Coverage</source>
        <translation>被覆率</translation>
    </message>
    <message>
        <source>confidence</source>
        <translation>信頼度</translation>
    </message>
    <message>
        <source>Markings by confidence</source>
        <translation>信頼度別の標示</translation>
    </message>
    <message>
        <source>Shift</source>
        <translation>移動量</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>軸</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>点</translation>
    </message>
    <message>
        <source>before east (m)</source>
        <translation>調整前 東 (m)</translation>
    </message>
    <message>
        <source>before north (m)</source>
        <translation>調整前 北 (m)</translation>
    </message>
    <message>
        <source>before up (m)</source>
        <translation>補正前 高さ (m)</translation>
    </message>
    <message>
        <source>after east (m)</source>
        <translation>調整後 東 (m)</translation>
    </message>
    <message>
        <source>after north (m)</source>
        <translation>調整後 北 (m)</translation>
    </message>
    <message>
        <source>after up (m)</source>
        <translation>補正後 高さ (m)</translation>
    </message>
    <message>
        <source>left out east (m)</source>
        <translation>除外時 東 (m)</translation>
    </message>
    <message>
        <source>left out north (m)</source>
        <translation>除外時 北 (m)</translation>
    </message>
    <message>
        <source>left out up (m)</source>
        <translation>除外時 高さ (m)</translation>
    </message>
    <message>
        <source>Cloud less truth. The height at a point is that of a plane through the ground points around it.</source>
        <translation>点群の値から真値を引いたもの。各点の高さは、まわりの地面の点に当てはめた平面の高さです。</translation>
    </message>
    <message>
        <source>Laser points shifted to control points</source>
        <translation>調整点に合わせて移動した航空レーザ点群</translation>
    </message>
    <message>
        <source>Corrections of the frames</source>
        <translation>写真の補正</translation>
    </message>
    <message>
        <source>Corrected less given, metres and degrees.</source>
        <translation>補正後の値から与えた値を引いたもの（m、度）。</translation>
    </message>
    <message>
        <source>Accuracy of the frames</source>
        <translation>写真の精度</translation>
    </message>
    <message>
        <source>Standard deviations after the adjustment, metres and degrees. A point's error is how far from it its pixel comes to lie on the ground, at the point's height.</source>
        <translation>調整後の標準偏差（m、度）。点の誤差は、その画素を点の高さの地上に写した位置と点との隔たりです。</translation>
    </message>
    <message>
        <source>Frames adjusted to control points</source>
        <translation>標定点による写真の調整</translation>
    </message>
    <message>
        <source>Roofs were told by</source>
        <translation>屋根の判別方法</translation>
    </message>
    <message>
        <source>Roof points a m2</source>
        <translation>屋根の点（点/m2）</translation>
    </message>
    <message>
        <source>Area of the buildings (m2)</source>
        <translation>建物の面積（m2）</translation>
    </message>
    <message>
        <source>Median sigma of the edges (m)</source>
        <translation>縁の標準偏差の中央値（m）</translation>
    </message>
    <message>
        <source>Groups of points below the least area</source>
        <translation>最小面積に満たない点の集まり</translation>
    </message>
    <message>
        <source>Outlines left out as crowns</source>
        <translation>樹冠として除いた外周線</translation>
    </message>
    <message>
        <source>What may be no building</source>
        <translation>建物でない可能性のあるもの</translation>
    </message>
    <message>
        <source>Merged building models</source>
        <translation>統合した建物モデル</translation>
    </message>
    <message>
        <source>Mean offset of the moved walls (m)</source>
        <translation>移動した壁面の平均オフセット (m)</translation>
    </message>
    <message>
        <source>largest offset of a wall (m)</source>
        <translation>壁面の最大オフセット (m)</translation>
    </message>
    <message>
        <source>Not merged or unchanged</source>
        <translation>未統合または変更なし</translation>
    </message>
    <message>
        <source>no points, no roof, no outline, or no valid solid could be made</source>
        <translation>点、屋根、外周線のいずれかがないか、有効な立体を作成できませんでした</translation>
    </message>
    <message>
        <source>level roofs or one height for all, as the detailed solid was not valid or did not fit</source>
        <translation>詳細な立体が不正または不適合のため、陸屋根または全体を一つの高さとしました</translation>
    </message>
    <message>
        <source>too few points for roofs: one height for the whole outline</source>
        <translation>屋根には点が少なすぎるため、外周線全体を一つの高さとしました</translation>
    </message>
    <message>
        <source>many points that can be roof lie far from the model: roofs are missing or metres off</source>
        <translation>屋根となり得る多くの点がモデルから離れています。屋根の欠落または数mのずれがあります</translation>
    </message>
    <message>
        <source>a roof found in the points is not in the model</source>
        <translation>点群で見つかった屋根がモデルにありません</translation>
    </message>
    <message>
        <source>lower than a storey over the ground: a deck, a platform, or ground taken for a roof</source>
        <translation>地表からの高さが1階分未満です。デッキ、プラットホーム、または地表面を屋根とみなしたものです</translation>
    </message>
    <message>
        <source>its ground is not known: taken from neighbours, or put under the lowest roof</source>
        <translation>地表面が不明です。近隣の値を用いたか、最も低い屋根の下に置きました</translation>
    </message>
    <message>
        <source>a large part of the outline has no model</source>
        <translation>外周線の大部分にモデルがありません</translation>
    </message>
    <message>
        <source>the point cloud ends in the building: what lies beyond is not seen</source>
        <translation>点群が建物の途中で終わっています。その先は計測されていません</translation>
    </message>
    <message>
        <source>a large part of the plan has no roof points</source>
        <translation>平面の大部分に屋根の点がありません</translation>
    </message>
    <message>
        <source>so few points that parts of the roof cannot be separated</source>
        <translation>点が少なく、屋根の各部を分離できません</translation>
    </message>
    <message>
        <source>a plan too small for the shape of a roof to be seen</source>
        <translation>平面が小さく、屋根の形状を判別できません</translation>
    </message>
    <message>
        <source>a valid solid from its roofs, near all of its points</source>
        <translation>屋根から作成した有効な立体で、ほぼすべての点に近接しています</translation>
    </message>
    <message>
        <source>Mean RMSE of roof heights (m)</source>
        <translation>屋根の高さの平均RMSE (m)</translation>
    </message>
    <message>
        <source>Mean RMSE of the best 95 % (m)</source>
        <translation>良い方の95 %の平均RMSE (m)</translation>
    </message>
    <message>
        <source>Mean point to model distance, RMSE (m)</source>
        <translation>点とモデルの平均距離、RMSE (m)</translation>
    </message>
    <message>
        <source>Mean quality, 0 to 1</source>
        <translation>平均品質（0～1）</translation>
    </message>
    <message>
        <source>what it says</source>
        <translation>内容</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>品質</translation>
    </message>
    <message>
        <source>Distances to the models of all points that can be roof, whether or not a roof was made of them. Level roofs (lod 1.3) in place of sloped ones show the slope as height differences.</source>
        <translation>屋根となり得るすべての点からモデルまでの距離です。屋根が作成されたかどうかは問いません。傾斜屋根を陸屋根（lod 1.3）で表した場合、勾配は高さの差として現れます。</translation>
    </message>
    <message>
        <source>% of the points</source>
        <translation>点の%</translation>
    </message>
    <message>
        <source>Buildings by points that the model does not explain</source>
        <translation>モデルで説明できない点の割合別の建物</translation>
    </message>
    <message>
        <source>RMSE of height, best 95 % (m)</source>
        <translation>高さのRMSE、良い方の95 % (m)</translation>
    </message>
    <message>
        <source>Buildings by height error</source>
        <translation>高さの誤差別の建物</translation>
    </message>
    <message>
        <source>95th percentile of distance (m)</source>
        <translation>距離の95パーセンタイル (m)</translation>
    </message>
    <message>
        <source>Buildings by point to model distance</source>
        <translation>点とモデルの距離別の建物</translation>
    </message>
    <message>
        <source>Buildings by point density</source>
        <translation>点密度別の建物</translation>
    </message>
    <message>
        <source>% of the plan</source>
        <translation>平面の%</translation>
    </message>
    <message>
        <source>Buildings by plan without points</source>
        <translation>点のない平面の割合別の建物</translation>
    </message>
    <message>
        <source>Updated city model</source>
        <translation>更新した都市モデル</translation>
    </message>
    <message>
        <source>Offset of the epochs</source>
        <translation>両時期のずれ</translation>
    </message>
    <message>
        <source>East (m)</source>
        <translation>東（m）</translation>
    </message>
    <message>
        <source>North (m)</source>
        <translation>北（m）</translation>
    </message>
    <message>
        <source>Up (m)</source>
        <translation>上（m）</translation>
    </message>
    <message>
        <source>Standard deviation up (m)</source>
        <translation>上方向の標準偏差（m）</translation>
    </message>
    <message>
        <source>Standard deviation of one cell (m)</source>
        <translation>1セルの標準偏差（m）</translation>
    </message>
    <message>
        <source>height change (m)</source>
        <translation>高さの変化（m）</translation>
    </message>
    <message>
        <source>area change (m2)</source>
        <translation>面積の変化（m2）</translation>
    </message>
    <message>
        <source>Walls adjusted by GNSS</source>
        <translation>GNSSで調整した壁面</translation>
    </message>
    <message>
        <source>Held back to keep buildings valid</source>
        <translation>建物の有効性維持のため移動を保留</translation>
    </message>
    <message>
        <source>Not observable</source>
        <translation>観測不可</translation>
    </message>
    <message>
        <source>Independent observations</source>
        <translation>独立な観測値</translation>
    </message>
    <message>
        <source>Signals in them</source>
        <translation>含まれる信号数</translation>
    </message>
    <message>
        <source>Median sigma of adjusted walls, m</source>
        <translation>調整した壁面のσの中央値、m</translation>
    </message>
    <message>
        <source>Median size of their offsets, m</source>
        <translation>オフセットの大きさの中央値、m</translation>
    </message>
    <message>
        <source>Median sigma of likely walls, m</source>
        <translation>推定の壁の標準偏差の中央値（m）</translation>
    </message>
    <message>
        <source>Iterations until nothing changed</source>
        <translation>収束までの反復回数</translation>
    </message>
    <message>
        <source>Walls before and after</source>
        <translation>調整前後の壁面</translation>
    </message>
    <message>
        <source>Buildings as given (grey). Adjusted and likely walls: where they stood (dashed) and where they stand now, blue inwards, red outwards; the label is the offset in cm. Orange: observed, but not decided.</source>
        <translation>入力の建物（灰色）。調整・推定した壁：元の位置（破線）と現在の位置（内向きは青、外向きは赤）。数字は移動量（cm）。橙：観測はあるが決まらない壁。</translation>
    </message>
    <message>
        <source>Walls that stay where they are</source>
        <translation>移動しない壁面</translation>
    </message>
    <message>
        <source>A wall that is not observable may stand where the model has it or a metre off: nothing is known of it. More passes help where observations are few; nothing helps under open sky.</source>
        <translation>観測できない壁面は、モデルの位置にある場合も1 mずれている場合もあり、何も分かりません。観測が少ない箇所では走行を増やすと有効ですが、上空が開けた場所では効果がありません。</translation>
    </message>
    <message>
        <source>Walls with observations</source>
        <translation>観測値のある壁面</translation>
    </message>
    <message>
        <source>offset, m</source>
        <translation>オフセット、m</translation>
    </message>
    <message>
        <source>sigma, m</source>
        <translation>σ、m</translation>
    </message>
    <message>
        <source>moved, m</source>
        <translation>移動量、m</translation>
    </message>
    <message>
        <source>passes</source>
        <translation>走行数</translation>
    </message>
    <message>
        <source>share of inliers</source>
        <translation>正常値の割合</translation>
    </message>
    <message>
        <source>How the observations scatter</source>
        <translation>観測値のばらつき</translation>
    </message>
    <message>
        <source>Error of an observation besides its noise, m</source>
        <translation>観測値の雑音以外の誤差、m</translation>
    </message>
    <message>
        <source>Factor of the noise expected</source>
        <translation>予想雑音に対する倍率</translation>
    </message>
    <message>
        <source>Share of NLOS-delayed ones</source>
        <translation>NLOS遅延の割合</translation>
    </message>
    <message>
        <source>Their mean delay, m</source>
        <translation>その平均遅延、m</translation>
    </message>
    <message>
        <source>Share of outliers</source>
        <translation>外れ値の割合</translation>
    </message>
    <message>
        <source>What the offsets leave of the observations: NLOS-delayed ones are to the right; the first and the last bar hold all that is beyond.</source>
        <translation>オフセット適用後の観測値の残差です。NLOS遅延のものは右側に現れます。両端の棒は範囲外をすべて含みます。</translation>
    </message>
    <message>
        <source>By system</source>
        <translation>衛星系別</translation>
    </message>
    <message>
        <source>Residuals in line of sight: median, m</source>
        <translation>見通し内の残差: 中央値、m</translation>
    </message>
    <message>
        <source>Residuals in line of sight: quartile range, m</source>
        <translation>見通し内の残差: 四分位範囲、m</translation>
    </message>
    <message>
        <source>Reflected signals with a known clock</source>
        <translation>時計誤差が既知の反射信号</translation>
    </message>
    <message>
        <source>of these within 5 m of prediction</source>
        <translation>うち予測との差が5 m以内</translation>
    </message>
    <message>
        <source>of these within 10 m of prediction</source>
        <translation>うち予測との差が10 m以内</translation>
    </message>
    <message>
        <source>of these: median difference, m</source>
        <translation>その差の中央値、m</translation>
    </message>
    <message>
        <source>Sky plot (grid north up, horizon outside): green in line of sight, orange reflected, grey blocked.</source>
        <translation>天空図（上が座標北、外周が地平線）: 緑は見通し内、橙は反射、灰は遮蔽。</translation>
    </message>
    <message>
        <source>what</source>
        <translation>項目</translation>
    </message>
    <message>
        <source>how many</source>
        <translation>数</translation>
    </message>
    <message>
        <source>signals without a known receiver clock (fewer than three in line of sight)</source>
        <translation>受信機時計誤差が不明な信号（見通し内が3衛星未満）</translation>
    </message>
    <message>
        <source>share of signals near an edge: class not sure</source>
        <translation>縁付近の信号の割合: 分類が不確実</translation>
    </message>
    <message>
        <source>epochs with the antenna within a building</source>
        <translation>アンテナが建物内にあるエポック</translation>
    </message>
    <message>
        <source>Reflections by ground, vehicles, bridges and trees, two reflections in a row and diffraction at edges are not traced; walls are taken for flat and upright.</source>
        <translation>地面、車両、橋、樹木による反射、2回反射、縁での回折は追跡していません。壁面は平らで鉛直とみなしています。</translation>
    </message>
    <message>
        <source>No wall was moved: the observations do not decide. The table below tells why; more drives along the walls help.</source>
        <translation>移動した壁面はありません。観測値では判定できません。理由は下表のとおりです。壁面沿いの走行を増やすと有効です。</translation>
    </message>
    <message>
        <source>Measured against predicted excess path of reflected signals, m: dark where the class is sure. Above the line signals are late, at the foot the direct signal got through.</source>
        <translation>反射信号の過剰経路長の実測値と予測値、m。分類が確実なものは濃色です。線より上は信号の遅れ、下端は直接波の受信を示します。</translation>
    </message>
    <message>
        <source>residual, m</source>
        <translation>残差、m</translation>
    </message>
    <message>
        <source>Edges over images, before and after</source>
        <translation>画像に重ねたエッジ（補正前後）</translation>
    </message>
    <message>
        <source>Images</source>
        <translation>画像</translation>
    </message>
    <message>
        <source>No edge lies in any of the images: they are of another place.</source>
        <translation>どの画像にもエッジがありません。別の場所の画像です。</translation>
    </message>
    <message>
        <source>Area, m²</source>
        <translation>面積（m²）</translation>
    </message>
    <message>
        <source>Length of road, m</source>
        <translation>道路の長さ、m</translation>
    </message>
    <message>
        <source>Median sigma of the weakest direction, m</source>
        <translation>最も弱い方向のσの中央値、m</translation>
    </message>
    <message>
        <source>Places with a direction not determined</source>
        <translation>決まらない方向がある地点</translation>
    </message>
    <message>
        <source>Median share of scans that end elsewhere, all directions determined</source>
        <translation>別の場所に収束するスキャンの割合の中央値（すべての方向が決まる地点）</translation>
    </message>
    <message>
        <source>Places that look like others</source>
        <translation>他と紛らわしい地点</translation>
    </message>
    <message>
        <source>area, m²</source>
        <translation>面積（m²）</translation>
    </message>
    <message>
        <source>length, m</source>
        <translation>長さ、m</translation>
    </message>
    <message>
        <source>share</source>
        <translation>割合</translation>
    </message>
    <message>
        <source>source</source>
        <translation>情報源</translation>
    </message>
    <message>
        <source>along, m</source>
        <translation>進行方向、m</translation>
    </message>
    <message>
        <source>across, m</source>
        <translation>横方向、m</translation>
    </message>
    <message>
        <source>heading, degrees</source>
        <translation>方位、度</translation>
    </message>
    <message>
        <source>Medians over the places of which the source tells something. A direction without evidence keeps the sigma from before matching.</source>
        <translation>その情報源から何らかの情報が得られる地点の中央値です。根拠のない方向のσは照合前の値のままです。</translation>
    </message>
    <message>
        <source>sigma of the weakest direction, m</source>
        <translation>最も弱い方向のσ、m</translation>
    </message>
    <message>
        <source>Places by the semi-major axis of their error ellipse.</source>
        <translation>誤差楕円の長半径別の地点数。</translation>
    </message>
    <message>
        <source>Plan</source>
        <translation>平面図</translation>
    </message>
    <message>
        <source>Error ellipses, ten times enlarged, by class: green good, yellow usable, red poor, grey nothing can be said.</source>
        <translation>区分別の誤差楕円（10倍に拡大）: 緑は良好、黄は使用可、赤は不良、灰は判定不可。</translation>
    </message>
    <message>
        <source>Status</source>
        <translation>状態</translation>
    </message>
    <message>
        <source>Worst squares of 50 m</source>
        <translation>最も悪い 50 m 四方</translation>
    </message>
    <message>
        <source>Worst stretches</source>
        <translation>最も悪い区間</translation>
    </message>
    <message>
        <source>bearing, degrees</source>
        <translation>方位、度</translation>
    </message>
    <message>
        <source>Scans that end elsewhere</source>
        <translation>別の場所に収束したスキャン</translation>
    </message>
    <message>
        <source>Predicted against observed</source>
        <translation>予測と観測の比較</translation>
    </message>
    <message>
        <source>Scans were simulated at some of the places, with noise, vehicles and trees in the way, and registered to the map as vehicles match them: by the plugin's own NDT, or by ICP.</source>
        <translation>いくつかの地点で、雑音と車両・樹木による遮蔽を含む走査を模擬し、車両と同じ照合方法（本プラグインのNDT、またはICP）で地図に位置合わせしました。</translation>
    </message>
    <message>
        <source>Spearman's coefficient over all places</source>
        <translation>全地点のスピアマン順位相関係数</translation>
    </message>
    <message>
        <source>Median of it within a street</source>
        <translation>同一街路内での中央値</translation>
    </message>
    <message>
        <source>Share of the errors within the 95 % ellipse</source>
        <translation>95 %誤差楕円内の誤差の割合</translation>
    </message>
    <message>
        <source>Median observed error in plan, m</source>
        <translation>観測された水平誤差の中央値、m</translation>
    </message>
    <message>
        <source>Median predicted error in plan, m</source>
        <translation>予測された水平誤差の中央値、m</translation>
    </message>
    <message>
        <source>Share of the rays to walls that were hidden</source>
        <translation>壁面への光線のうち遮られた割合</translation>
    </message>
    <message>
        <source>Spearman's coefficient of scans that converge, directions determined</source>
        <translation>収束したスキャンのスピアマン順位相関係数（すべての方向が決まる地点）</translation>
    </message>
    <message>
        <source>Share of these within the 95 % ellipse</source>
        <translation>そのうち95 %誤差楕円に入る割合</translation>
    </message>
    <message>
        <source>Scans that end elsewhere ranked by the prediction, area under the ROC curve</source>
        <translation>別の場所に収束したスキャンの予測による順位付け（ROC曲線下面積）</translation>
    </message>
    <message>
        <source>Scans that fit another place better</source>
        <translation>別の地点により適合したスキャン</translation>
    </message>
    <message>
        <source>Root mean square errors in plan of each place; those above the picture are drawn at its edge.</source>
        <translation>各地点の水平位置の二乗平均平方根誤差です。図の範囲を超えるものは縁に描いています。</translation>
    </message>
    <message>
        <source>way, m</source>
        <translation>距離、m</translation>
    </message>
    <message>
        <source>predicted along, across, m</source>
        <translation>予測: 進行方向・横方向、m</translation>
    </message>
    <message>
        <source>observed along, across, m</source>
        <translation>観測: 進行方向・横方向、m</translation>
    </message>
    <message>
        <source>within 95 %</source>
        <translation>95 %以内</translation>
    </message>
    <message>
        <source>elsewhere</source>
        <translation>別の地点</translation>
    </message>
    <message>
        <source>Nothing can be said of any place; the table below tells why.</source>
        <translation>どの地点についても判定できません。理由は下表のとおりです。</translation>
    </message>
    <message>
        <source>No place could be simulated: walls tell nothing of any.</source>
        <translation>シミュレートできる地点がありません。どの地点でも壁面から情報が得られません。</translation>
    </message>
    <message>
        <source>Accuracy at control points</source>
        <translation>検証点での精度</translation>
    </message>
    <message>
        <source>Survey</source>
        <translation>計測</translation>
    </message>
    <message>
        <source>mean 2D (m)</source>
        <translation>2D平均 (m)</translation>
    </message>
    <message>
        <source>max 2D (m)</source>
        <translation>2D最大 (m)</translation>
    </message>
    <message>
        <source>std 2D (m)</source>
        <translation>2D標準偏差 (m)</translation>
    </message>
    <message>
        <source>mean 3D (m)</source>
        <translation>3D平均 (m)</translation>
    </message>
    <message>
        <source>max 3D (m)</source>
        <translation>3D最大 (m)</translation>
    </message>
    <message>
        <source>std 3D (m)</source>
        <translation>3D標準偏差 (m)</translation>
    </message>
    <message>
        <source>East, north and up are mean errors: what is left in all points alike.</source>
        <translation>東、北、上は平均誤差です。全点に共通して残る誤差を示します。</translation>
    </message>
    <message>
        <source>Control point</source>
        <translation>検証点</translation>
    </message>
    <message>
        <source>Horizontal error over time</source>
        <translation>水平誤差の時間変化</translation>
    </message>
    <message>
        <source>seconds since the first control point</source>
        <translation>最初の検証点からの秒数</translation>
    </message>
    <message>
        <source>placed</source>
        <translation>位置決定済み</translation>
    </message>
    <message>
        <source>bridged</source>
        <translation>補間</translation>
    </message>
    <message>
        <source>relative only</source>
        <translation>相対のみ</translation>
    </message>
    <message>
        <source>not tied</source>
        <translation>未結合</translation>
    </message>
    <message>
        <source>Adjustment of several drives</source>
        <translation>複数走行の調整</translation>
    </message>
    <message>
        <source>Residuals by kind</source>
        <translation>種別ごとの残差</translation>
    </message>
    <message>
        <source>Observation</source>
        <translation>観測値</translation>
    </message>
    <message>
        <source>without weight</source>
        <translation>重みなし</translation>
    </message>
    <message>
        <source>RMS in plan (m)</source>
        <translation>水平のRMS (m)</translation>
    </message>
    <message>
        <source>largest in plan (m)</source>
        <translation>水平の最大値 (m)</translation>
    </message>
    <message>
        <source>RMS in height (m)</source>
        <translation>高さのRMS (m)</translation>
    </message>
    <message>
        <source>largest in height (m)</source>
        <translation>高さの最大値 (m)</translation>
    </message>
    <message>
        <source>Drives</source>
        <translation>走行</translation>
    </message>
    <message>
        <source>Drive</source>
        <translation>走行</translation>
    </message>
    <message>
        <source>path length (m)</source>
        <translation>走行距離 (m)</translation>
    </message>
    <message>
        <source>mean correction in plan (m)</source>
        <translation>水平の平均補正量 (m)</translation>
    </message>
    <message>
        <source>median sigma in plan (m)</source>
        <translation>水平のσの中央値 (m)</translation>
    </message>
    <message>
        <source>largest sigma in plan (m)</source>
        <translation>水平のσの最大値 (m)</translation>
    </message>
    <message>
        <source>Witnesses</source>
        <translation>観測の寄与</translation>
    </message>
    <message>
        <source>Share that each kind of observation has in what is known of a drive in plan. Ties and planes lay drives on each other; control points, reference markings and walls place them.</source>
        <translation>走行の水平位置の情報に占める、各種類の観測の割合です。タイと平面は走行どうしを合わせ、基準点、基準の路面標示、壁は位置を決めます。</translation>
    </message>
    <message>
        <source>Largest residuals</source>
        <translation>最大の残差</translation>
    </message>
    <message>
        <source>in height (m)</source>
        <translation>高さ (m)</translation>
    </message>
    <message>
        <source>weight</source>
        <translation>重み</translation>
    </message>
    <message>
        <source>The drives agree with each other, but nothing fixes their place: give control points, reference markings or buildings, or use the result only for comparing drives.</source>
        <translation>走行どうしは一致していますが、位置を決めるものがありません。基準点、基準の路面標示または建物を指定するか、走行の比較だけに用いてください。</translation>
    </message>
    <message>
        <source>Distance between planes before, RMS (mm)</source>
        <translation>調整前の平面間距離、RMS (mm)</translation>
    </message>
    <message>
        <source>Distance between planes after, RMS (mm)</source>
        <translation>調整後の平面間距離、RMS (mm)</translation>
    </message>
    <message>
        <source>Passes apart, RMS (m)</source>
        <translation>走行間のずれ、RMS (m)</translation>
    </message>
    <message>
        <source>value</source>
        <translation>値</translation>
    </message>
    <message>
        <source>standard deviation</source>
        <translation>標準偏差</translation>
    </message>
    <message>
        <source>Lever arms in metres forward, right and down; angles in degrees about the body's axes. A misalignment of the inertial unit that all passes have in common is part of the angles.</source>
        <translation>レバーアームは前方・右・下のメートル、角度は車体軸まわりの度です。全走行に共通する慣性計測装置の取付誤差は角度に含まれます。</translation>
    </message>
    <message>
        <source>Calibration of scanners</source>
        <translation>スキャナの校正</translation>
    </message>
    <message>
        <source>The course as reported (grey) and rectified (blue; dashed where it is extrapolated beyond the sets), and the sets of tie points: green used, orange suspect, red left out.</source>
        <translation>補正前の軌跡（灰）と補正後の軌跡（青、対応点の組の範囲外への外挿は破線）、およびタイポイントの組: 緑は使用、橙は要注意、赤は除外。</translation>
    </message>
    <message>
        <source>Drift</source>
        <translation>ドリフト</translation>
    </message>
    <message>
        <source>Sets of tie points</source>
        <translation>タイポイントの組</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>組</translation>
    </message>
    <message>
        <source>Time, s</source>
        <translation>時刻、s</translation>
    </message>
    <message>
        <source>Pairs</source>
        <translation>対応点数</translation>
    </message>
    <message>
        <source>Before, m</source>
        <translation>補正前、m</translation>
    </message>
    <message>
        <source>After, m</source>
        <translation>補正後、m</translation>
    </message>
    <message>
        <source>East, m</source>
        <translation>東、m</translation>
    </message>
    <message>
        <source>North, m</source>
        <translation>北、m</translation>
    </message>
    <message>
        <source>Heading, °</source>
        <translation>方位、°</translation>
    </message>
    <message>
        <source>Misfit within, m</source>
        <translation>組内の残差、m</translation>
    </message>
    <message>
        <source>Off without itself, m</source>
        <translation>一つ抜き残差、m</translation>
    </message>
    <message>
        <source>Before and after: mean distance of the set's pairs from the reference. Off without itself: how far the set would lie from the reference if it were not used, which is more than what to expect halfway between sets.</source>
        <translation>補正前と補正後: 組の対応点の基準からの平均距離。一つ抜き残差: その組を使用しない場合の基準からのずれで、組と組の中間で予想される値より大きくなります。</translation>
    </message>
    <message>
        <source>Correction to the heading with its sigma.</source>
        <translation>方位の補正量とそのσ。</translation>
    </message>
    <message>
        <source>Height of the origin above the ground, m</source>
        <translation>原点の地上高、m</translation>
    </message>
    <message>
        <source>Samples along the course</source>
        <translation>軌跡に沿った標本数</translation>
    </message>
    <message>
        <source>left out, they stand out of their neighbours</source>
        <translation>除外、近隣から外れた標本</translation>
    </message>
    <message>
        <source>Share of the course with a ground</source>
        <translation>地表面のある軌跡の割合</translation>
    </message>
    <message>
        <source>Distance from the ground before, root mean square, m</source>
        <translation>補正前の地表面からの距離、二乗平均平方根、m</translation>
    </message>
    <message>
        <source>Sigma of a sample, m</source>
        <translation>標本のσ、m</translation>
    </message>
    <message>
        <source>Sigma of the heights, mean, m</source>
        <translation>高さのσ、平均、m</translation>
    </message>
    <message>
        <source>Correction to the height with its sigma, and the samples of the ground.</source>
        <translation>高さの補正量とそのσ、および地表面の標本。</translation>
    </message>
    <message>
        <source>The sigma of the tie points was found from how well they fit each other. An error that they share, such as that of the reference, is not in it nor in the sigmas of the epochs.</source>
        <translation>タイポイントのσは、相互の適合度から求めました。基準の誤差など共通する誤差は、このσにもエポックのσにも含まれません。</translation>
    </message>
    <message>
        <source>Heading correction</source>
        <translation>方位の補正</translation>
    </message>
    <message>
        <source>ground says</source>
        <translation>地表面による値</translation>
    </message>
    <message>
        <source>taken</source>
        <translation>採用値</translation>
    </message>
    <message>
        <source>sets</source>
        <translation>対応点の組</translation>
    </message>
    <message>
        <source>used</source>
        <translation>使用</translation>
    </message>
    <message>
        <source>used; its pairs lie too close together, as seen from the vehicle, to tell the heading</source>
        <translation>使用。対応点が車両から見て近接しすぎており、方位を決定できません</translation>
    </message>
    <message>
        <source>used, but far from where the other sets put it: check it</source>
        <translation>使用。ただし他の組による位置から離れています。確認してください</translation>
    </message>
    <message>
        <source>left out: the other sets put it elsewhere</source>
        <translation>除外: 他の組による位置と一致しません</translation>
    </message>
    <message>
        <source>left out: its pairs do not fit each other</source>
        <translation>除外: 対応点が互いに適合しません</translation>
    </message>
    <message>
        <source>left out: the paper's method needs two pairs</source>
        <translation>除外: 論文の手法には2つの対応点が必要です</translation>
    </message>
    <message>
        <source>paper</source>
        <translation>論文</translation>
    </message>
    <message>
        <source>best estimate of the drift from all tie points together</source>
        <translation>すべてのタイポイントを同時に用いたドリフトの最良推定</translation>
    </message>
    <message>
        <source>Z 3 to the letter: sets of two pairs (eq. 13 to 17), relative motions by iteration (eq. 8, 9)</source>
        <translation>Z 3の手法どおり: 2つの対応点からなる組（式13～17）、反復法による相対運動（式8、9）</translation>
    </message>
    <message>
        <source>Asphalt's intensity falls with range and incidence. The curve f(R) = C + A R^-b (1 - exp(-(R/d)^2)) is fitted to the asphalt of each scanner; intensities are divided by it up to R1, by the smallest value from there to R2, and left out beyond (Javanmardi, eq. 4).</source>
        <translation>アスファルトの反射強度は斜距離と入射角に応じて低下します。曲線f(R) = C + A R^-b (1 - exp(-(R/d)^2))をスキャナごとにアスファルトに当てはめ、反射強度をR1まではこの値で、R1からR2までは最小値で除し、R2を超えるものは除外します(Javanmardi, 式4)。</translation>
    </message>
    <message>
        <source>Outside the trajectory's time</source>
        <translation>軌跡の時間範囲外</translation>
    </message>
    <message>
        <source>Measured while standing (left out)</source>
        <translation>停車中の計測（除外）</translation>
    </message>
    <message>
        <source>Within range of the vehicle</source>
        <translation>車両からの距離範囲内</translation>
    </message>
    <message>
        <source>On the ground</source>
        <translation>地表面上</translation>
    </message>
    <message>
        <source>Ground told by</source>
        <translation>地表面の判定</translation>
    </message>
    <message>
        <source>Ground within R2</source>
        <translation>R2以内の地表面</translation>
    </message>
    <message>
        <source>Share of marking points among these, %</source>
        <translation>うち路面標示点の割合、%</translation>
    </message>
    <message>
        <source>Contrast of paint to the ground beside it (median)</source>
        <translation>標示と隣接路面のコントラスト（中央値）</translation>
    </message>
    <message>
        <source>Path with markings, %</source>
        <translation>標示のある軌跡の割合、%</translation>
    </message>
    <message>
        <source>Scatter of the ground's heights, m</source>
        <translation>地表面の高さのばらつき、m</translation>
    </message>
    <message>
        <source>Reference intensity</source>
        <translation>基準反射強度</translation>
    </message>
    <message>
        <source>Lasers told apart by</source>
        <translation>レーザの区別</translation>
    </message>
    <message>
        <source>Lasers (of the angle: bins of 0.1 degrees) used</source>
        <translation>使用したレーザ（角度の場合は0.1度の階級）</translation>
    </message>
    <message>
        <source>Left out (no signal or too much scatter)</source>
        <translation>除外（信号なし、またはばらつき過大）</translation>
    </message>
    <message>
        <source>Smallest gain</source>
        <translation>最小ゲイン</translation>
    </message>
    <message>
        <source>Largest gain</source>
        <translation>最大ゲイン</translation>
    </message>
    <message>
        <source>Scatter on even ground before, %</source>
        <translation>補正前の平坦な地表面でのばらつき、%</translation>
    </message>
    <message>
        <source>After, %</source>
        <translation>補正後、%</translation>
    </message>
    <message>
        <source>Asphalt's intensity in bins of 0.25 m (dots; grey: not used), the fitted curve as it is applied (line), R1 and R2.</source>
        <translation>0.25 mの階級ごとのアスファルトの反射強度（点、灰は不使用）、適用する近似曲線（線）、R1とR2。</translation>
    </message>
    <message>
        <source>C (floor)</source>
        <translation>C（下限）</translation>
    </message>
    <message>
        <source>A (at 1 m)</source>
        <translation>A（1 mでの値）</translation>
    </message>
    <message>
        <source>b (fall)</source>
        <translation>b（減衰）</translation>
    </message>
    <message>
        <source>d (loss near the scanner), m</source>
        <translation>d（スキャナ近傍の損失）、m</translation>
    </message>
    <message>
        <source>Shortest range, m</source>
        <translation>最短斜距離、m</translation>
    </message>
    <message>
        <source>I_M (largest intensity of asphalt)</source>
        <translation>I_M（アスファルトの最大反射強度）</translation>
    </message>
    <message>
        <source>I_m (smallest)</source>
        <translation>I_m（最小）</translation>
    </message>
    <message>
        <source>Bins used</source>
        <translation>使用した階級</translation>
    </message>
    <message>
        <source>Residual of the bins (robust), %</source>
        <translation>階級の残差（ロバスト）、%</translation>
    </message>
    <message>
        <source>Scatter of single asphalt points, %</source>
        <translation>アスファルト単点のばらつき、%</translation>
    </message>
    <message>
        <source>Asphalt</source>
        <translation>アスファルト</translation>
    </message>
    <message>
        <source>Curve</source>
        <translation>曲線</translation>
    </message>
    <message>
        <source>Difference, %</source>
        <translation>差、%</translation>
    </message>
    <message>
        <source>Used</source>
        <translation>使用</translation>
    </message>
    <message>
        <source>registered</source>
        <translation>位置合わせ済み</translation>
    </message>
    <message>
        <source>not to be trusted</source>
        <translation>信頼できない</translation>
    </message>
    <message>
        <source>weak</source>
        <translation>拘束が弱い</translation>
    </message>
    <message>
        <source>ambiguous</source>
        <translation>曖昧</translation>
    </message>
    <message>
        <source>no markings</source>
        <translation>標示なし</translation>
    </message>
    <message>
        <source>not converged</source>
        <translation>収束せず</translation>
    </message>
    <message>
        <source>Registration of a mobile survey</source>
        <translation>MMS計測の位置合わせ</translation>
    </message>
    <message>
        <source>Registered: found from markings around. Bridged: between or beyond registered parts, by how trajectories drift. Not to be trusted: too far from them, or markings that contradict. Standard deviations are absolute as far as the stated accuracy of the reference is: they include it, and steps of the reference too small to be told. What all of the reference is off by no survey shows: measure a few control points, and state it.</source>
        <translation>位置合わせ済み：周囲の標示から求めた位置。補間：位置合わせ済みの区間の間または先で、軌跡のドリフトの性質から求めた位置。信頼できない：それらから遠すぎる、または矛盾する標示。標準偏差は、指定された基準の精度の範囲で絶対的なものです。基準の精度と、検出できないほど小さい基準の段差を含みます。基準全体のずれはどの計測からも分かりません。いくつかの標定点を測り、その精度を指定してください。</translation>
    </message>
    <message>
        <source>Correction along the path</source>
        <translation>軌跡に沿った補正量</translation>
    </message>
    <message>
        <source>Correction of the reported angles</source>
        <translation>補正前の角度に対する補正量</translation>
    </message>
    <message>
        <source>Windows</source>
        <translation>ウィンドウ</translation>
    </message>
    <message>
        <source>Length of the window of each patch: as long as it needs for enough markings</source>
        <translation>各パッチのウィンドウ長: 十分な標示が得られる長さ</translation>
    </message>
    <message>
        <source>From (m)</source>
        <translation>始点 (m)</translation>
    </message>
    <message>
        <source>to (m)</source>
        <translation>終点 (m)</translation>
    </message>
    <message>
        <source>from time (s)</source>
        <translation>開始時刻 (s)</translation>
    </message>
    <message>
        <source>to time (s)</source>
        <translation>終了時刻 (s)</translation>
    </message>
    <message>
        <source>largest sigma (m)</source>
        <translation>最大のσ (m)</translation>
    </message>
    <message>
        <source>Where reference and survey disagree</source>
        <translation>基準と計測が一致しない箇所</translation>
    </message>
    <message>
        <source>At (m)</source>
        <translation>位置（m）</translation>
    </message>
    <message>
        <source>size (m)</source>
        <translation>大きさ（m）</translation>
    </message>
    <message>
        <source>towards (degrees)</source>
        <translation>方向（度）</translation>
    </message>
    <message>
        <source>Markings before and after</source>
        <translation>補正前後の標示</translation>
    </message>
    <message>
        <source>No part of the path is registered: the result is as reported. Check that the reference is of the same place, and its date.</source>
        <translation>位置合わせ済みの区間がないため、結果は補正前のままです。基準が同じ場所のものか、またその時期を確認してください。</translation>
    </message>
    <message>
        <source>Each patch is moved by its own window, as in the paper: between patches there are steps, nothing is bridged, and patches that are not to be trusted are moved all the same.</source>
        <translation>論文どおり、各パッチを固有のウィンドウで移動しています。パッチ間には段差が生じ、補間は行わず、信頼できないパッチも移動しています。</translation>
    </message>
    <message>
        <source>Heights, roll and pitch were not touched.</source>
        <translation>高さ、ロール、ピッチは変更していません。</translation>
    </message>
    <message>
        <source>window length</source>
        <translation>ウィンドウ長</translation>
    </message>
    <message>
        <source>overlap</source>
        <translation>重なり率</translation>
    </message>
    <message>
        <source>windows</source>
        <translation>ウィンドウ数</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>完了</translation>
    </message>
    <message>
        <source>Empty</source>
        <translation>空</translation>
    </message>
    <message>
        <source>Failed</source>
        <translation>失敗</translation>
    </message>
    <message>
        <source>Kept from an earlier run</source>
        <translation>以前の実行から保持</translation>
    </message>
    <message>
        <source>Buffer (m)</source>
        <translation>バッファ (m)</translation>
    </message>
    <message>
        <source>Time of all tiles (s)</source>
        <translation>全タイルの時間 (s)</translation>
    </message>
    <message>
        <source>Processor time of all tiles (s)</source>
        <translation>全タイルのプロセッサ時間 (s)</translation>
    </message>
    <message>
        <source>Slowest tile (s)</source>
        <translation>最も遅いタイル (s)</translation>
    </message>
    <message>
        <source>Greatest memory of a process (MB)</source>
        <translation>プロセスの最大メモリ (MB)</translation>
    </message>
    <message>
        <source>Disk of the results (MB)</source>
        <translation>結果のディスク使用量 (MB)</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>理由</translation>
    </message>
    <message>
        <source>Time (s)</source>
        <translation>時間 (s)</translation>
    </message>
    <message>
        <source>time of a tile (s)</source>
        <translation>タイルの処理時間 (s)</translation>
    </message>
    <message>
        <source>How long the tiles took.</source>
        <translation>タイルの所要時間。</translation>
    </message>
    <message>
        <source>placed, σ up to 5 cm</source>
        <translation>位置決定済み、σ 5 cm以下</translation>
    </message>
    <message>
        <source>placed, σ above 5 cm</source>
        <translation>位置決定済み、σ 5 cm超</translation>
    </message>
    <message>
        <source>residual below 2 cm</source>
        <translation>残差 2 cm未満</translation>
    </message>
    <message>
        <source>2 to 5 cm</source>
        <translation>2～5 cm</translation>
    </message>
    <message>
        <source>5 cm and more</source>
        <translation>5 cm以上</translation>
    </message>
    <message>
        <source>ok</source>
        <translation>良好</translation>
    </message>
    <message>
        <source>error exceeded</source>
        <translation>誤差超過</translation>
    </message>
    <message>
        <source>ground assumed</source>
        <translation>地表面は仮定</translation>
    </message>
    <message>
        <source>small</source>
        <translation>小規模</translation>
    </message>
    <message>
        <source>part of the plan without points</source>
        <translation>平面の一部に点なし</translation>
    </message>
    <message>
        <source>the cloud ends in it</source>
        <translation>点群が途中で終わる</translation>
    </message>
    <message>
        <source>part of the outline without model</source>
        <translation>外周線の一部にモデルなし</translation>
    </message>
    <message>
        <source>lost roofs</source>
        <translation>屋根の欠落</translation>
    </message>
    <message>
        <source>points not explained</source>
        <translation>説明できない点あり</translation>
    </message>
    <message>
        <source>simplified</source>
        <translation>簡略化</translation>
    </message>
    <message>
        <source>plain block</source>
        <translation>単純ブロック</translation>
    </message>
    <message>
        <source>not modelled (see table)</source>
        <translation>モデルなし（表を参照）</translation>
    </message>
    <message>
        <source>outer wall</source>
        <translation>外壁</translation>
    </message>
    <message>
        <source>inner wall</source>
        <translation>内壁</translation>
    </message>
    <message>
        <source>warning</source>
        <translation>警告</translation>
    </message>
    <message>
        <source>info</source>
        <translation>情報</translation>
    </message>
    <message>
        <source>error below 3 cm</source>
        <translation>誤差 3 cm未満</translation>
    </message>
    <message>
        <source>3 to 10 cm</source>
        <translation>3～10 cm</translation>
    </message>
    <message>
        <source>10 to 30 cm</source>
        <translation>10～30 cm</translation>
    </message>
    <message>
        <source>more than 30 cm</source>
        <translation>30 cm超</translation>
    </message>
    <message>
        <source>lower than a storey</source>
        <translation>1階分より低い</translation>
    </message>
    <message>
        <source>vehicle or container</source>
        <translation>車両またはコンテナ</translation>
    </message>
    <message>
        <source>bridge or ramp</source>
        <translation>橋または斜路</translation>
    </message>
    <message>
        <source>no ground about it</source>
        <translation>周囲に地面なし</translation>
    </message>
    <message>
        <source>seen well</source>
        <translation>良好に計測</translation>
    </message>
    <message>
        <source>seen in part</source>
        <translation>一部計測</translation>
    </message>
    <message>
        <source>rough</source>
        <translation>ばらつき大</translation>
    </message>
    <message>
        <source>inside the outline</source>
        <translation>外周線の内側</translation>
    </message>
    <message>
        <source>before the facade</source>
        <translation>壁面の手前</translation>
    </message>
    <message>
        <source>undecided</source>
        <translation>判定不能</translation>
    </message>
    <message>
        <source>textured</source>
        <translation>テクスチャあり</translation>
    </message>
    <message>
        <source>agree to half a pixel</source>
        <translation>半画素以内で一致</translation>
    </message>
    <message>
        <source>apart</source>
        <translation>ずれ</translation>
    </message>
    <message>
        <source>not alike</source>
        <translation>一致しない</translation>
    </message>
    <message>
        <source>displaced by heights</source>
        <translation>高さによるずれ</translation>
    </message>
    <message>
        <source>as given</source>
        <translation>入力のまま</translation>
    </message>
    <message>
        <source>reflected</source>
        <translation>反射</translation>
    </message>
    <message>
        <source>blocked</source>
        <translation>遮蔽</translation>
    </message>
    <message>
        <source>adjusted inwards</source>
        <translation>内側へ調整</translation>
    </message>
    <message>
        <source>adjusted outwards</source>
        <translation>外側へ調整</translation>
    </message>
    <message>
        <source>held: the building would not stay valid</source>
        <translation>保留: 建物が有効でなくなるため</translation>
    </message>
    <message>
        <source>observed, not decided</source>
        <translation>観測あり、判定不可</translation>
    </message>
    <message>
        <source>普通建物 ordinary building</source>
        <translation>普通建物</translation>
    </message>
    <message>
        <source>堅ろう建物 solid building</source>
        <translation>堅ろう建物</translation>
    </message>
    <message>
        <source>普通無壁舎 ordinary, no walls</source>
        <translation>普通無壁舎</translation>
    </message>
    <message>
        <source>堅ろう無壁舎 solid, no walls</source>
        <translation>堅ろう無壁舎</translation>
    </message>
    <message>
        <source>other</source>
        <translation>その他</translation>
    </message>
    <message>
        <source>road border</source>
        <translation>道路境界</translation>
    </message>
    <message>
        <source>virtual</source>
        <translation>仮想</translation>
    </message>
    <message>
        <source>virtual, through a junction</source>
        <translation>仮想（交差点内）</translation>
    </message>
    <message>
        <source>sound</source>
        <translation>良好</translation>
    </message>
    <message>
        <source>with a note</source>
        <translation>備考あり</translation>
    </message>
    <message>
        <source>ordinary section</source>
        <translation>一般区間</translation>
    </message>
    <message>
        <source>viaduct</source>
        <translation>高架</translation>
    </message>
    <message>
        <source>bridge</source>
        <translation>橋梁</translation>
    </message>
    <message>
        <source>underpass</source>
        <translation>アンダーパス</translation>
    </message>
    <message>
        <source>tunnel</source>
        <translation>トンネル</translation>
    </message>
    <message>
        <source>others</source>
        <translation>その他</translation>
    </message>
    <message>
        <source>furniture</source>
        <translation>都市設備</translation>
    </message>
    <message>
        <source>nothing can be said</source>
        <translation>判定不可</translation>
    </message>
    <message>
        <source>below 10 cm</source>
        <translation>10 cm未満</translation>
    </message>
    <message>
        <source>30 to 50 cm</source>
        <translation>30～50 cm</translation>
    </message>
    <message>
        <source>50 cm to 1 m</source>
        <translation>50 cm～1 m</translation>
    </message>
    <message>
        <source>above 1 m</source>
        <translation>1 m超</translation>
    </message>
    <message>
        <source>open end</source>
        <translation>開放端</translation>
    </message>
    <message>
        <source>bound not seen</source>
        <translation>境界線の未計測</translation>
    </message>
    <message>
        <source>direction contradicts</source>
        <translation>方向の矛盾</translation>
    </message>
    <message>
        <source>driven without lane</source>
        <translation>車線のない走行</translation>
    </message>
    <message>
        <source>no drive</source>
        <translation>走行なし</translation>
    </message>
    <message>
        <source>stop line without lane</source>
        <translation>車線のない停止線</translation>
    </message>
    <message>
        <source>too narrow</source>
        <translation>幅不足</translation>
    </message>
    <message>
        <source>way not drawn</source>
        <translation>経路の未描画</translation>
    </message>
    <message>
        <source>way drawn by width</source>
        <translation>車線幅で描いた経路</translation>
    </message>
    <message>
        <source>no height</source>
        <translation>高さなし</translation>
    </message>
    <message>
        <source>way possible</source>
        <translation>可能な進路</translation>
    </message>
    <message>
        <source>right of way inferred</source>
        <translation>推定した優先関係</translation>
    </message>
    <message>
        <source>diamond</source>
        <translation>ひし形</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>不明</translation>
    </message>
    <message>
        <source>arrow straight</source>
        <translation>矢印 直進</translation>
    </message>
    <message>
        <source>arrow left</source>
        <translation>矢印 左折</translation>
    </message>
    <message>
        <source>arrow right</source>
        <translation>矢印 右折</translation>
    </message>
    <message>
        <source>arrow straight left</source>
        <translation>矢印 直進・左折</translation>
    </message>
    <message>
        <source>arrow straight right</source>
        <translation>矢印 直進・右折</translation>
    </message>
    <message>
        <source>arrow, kind unknown</source>
        <translation>矢印 種別不明</translation>
    </message>
    <message>
        <source>guiding strip</source>
        <translation>視覚障害者誘導用ブロック</translation>
    </message>
    <message>
        <source>no marking</source>
        <translation>標示なし</translation>
    </message>
    <message>
        <source>on measured walls</source>
        <translation>計測壁面上</translation>
    </message>
    <message>
        <source>unchanged</source>
        <translation>変更なし</translation>
    </message>
    <message>
        <source>not merged (see table)</source>
        <translation>統合なし（表を参照）</translation>
    </message>
    <message>
        <source>on the measured wall</source>
        <translation>計測壁面上へ移動</translation>
    </message>
    <message>
        <source>lay on it already</source>
        <translation>元から計測壁面上</translation>
    </message>
    <message>
        <source>beyond the limits</source>
        <translation>限界値超過</translation>
    </message>
    <message>
        <source>would cross a neighbour</source>
        <translation>隣接建物と交差</translation>
    </message>
    <message>
        <source>does not fit the plan</source>
        <translation>平面形状に不適合</translation>
    </message>
    <message>
        <source>registered, σ up to 3 cm</source>
        <translation>位置合わせ済み、σ 3 cm以下</translation>
    </message>
    <message>
        <source>registered, σ 3 to 6 cm</source>
        <translation>位置合わせ済み、σ 3～6 cm</translation>
    </message>
    <message>
        <source>registered, σ above 6 cm</source>
        <translation>位置合わせ済み、σ 6 cm超</translation>
    </message>
    <message>
        <source>σ up to 5 cm</source>
        <translation>σ 5 cm以下</translation>
    </message>
    <message>
        <source>σ 5 to 20 cm</source>
        <translation>σ 5～20 cm</translation>
    </message>
    <message>
        <source>σ above 20 cm</source>
        <translation>σ 20 cm超</translation>
    </message>
    <message>
        <source>carried on before the first or after the last set</source>
        <translation>最初の組より前または最後の組より後への外挿</translation>
    </message>
    <message>
        <source>used for the position only</source>
        <translation>位置にのみ使用</translation>
    </message>
    <message>
        <source>used, but hardly fits its neighbours</source>
        <translation>使用、ただし近隣との適合が不十分</translation>
    </message>
    <message>
        <source>carriageway, continued</source>
        <translation>車道部（延長）</translation>
    </message>
    <message>
        <source>junction, continued</source>
        <translation>交差部（延長）</translation>
    </message>
    <message>
        <source>lane, continued</source>
        <translation>車線（延長）</translation>
    </message>
    <message>
        <source>sidewalk, continued</source>
        <translation>歩道部（延長）</translation>
    </message>
    <message>
        <source>island, continued</source>
        <translation>島（延長）</translation>
    </message>
    <message>
        <source>road, not surveyed, continued</source>
        <translation>未計測の道路（延長）</translation>
    </message>
    <message>
        <source>carriageway, doubtful</source>
        <translation>車道部（不確か）</translation>
    </message>
    <message>
        <source>junction, doubtful</source>
        <translation>交差部（不確か）</translation>
    </message>
    <message>
        <source>lane, doubtful</source>
        <translation>車線（不確か）</translation>
    </message>
    <message>
        <source>sidewalk, doubtful</source>
        <translation>歩道部（不確か）</translation>
    </message>
    <message>
        <source>island, doubtful</source>
        <translation>島（不確か）</translation>
    </message>
    <message>
        <source>road, not surveyed, doubtful</source>
        <translation>未計測の道路（不確か）</translation>
    </message>
    <message>
        <source>kerb, measured</source>
        <translation>縁石（計測）</translation>
    </message>
    <message>
        <source>kerb, doubtful</source>
        <translation>縁石（不確実）</translation>
    </message>
    <message>
        <source>lowered kerb, measured</source>
        <translation>切下げ縁石（計測）</translation>
    </message>
    <message>
        <source>lowered kerb, doubtful</source>
        <translation>切下げ縁石（不確実）</translation>
    </message>
    <message>
        <source>road border, measured</source>
        <translation>道路境界（計測）</translation>
    </message>
    <message>
        <source>road border, doubtful</source>
        <translation>道路境界（不確実）</translation>
    </message>
    <message>
        <source>guard rail, measured</source>
        <translation>防護柵（計測）</translation>
    </message>
    <message>
        <source>guard rail, doubtful</source>
        <translation>防護柵（不確実）</translation>
    </message>
    <message>
        <source>wall, measured</source>
        <translation>壁面（計測）</translation>
    </message>
    <message>
        <source>wall, doubtful</source>
        <translation>壁面（不確実）</translation>
    </message>
    <message>
        <source>edge continued</source>
        <translation>道路縁を延長</translation>
    </message>
    <message>
        <source>edge doubtful</source>
        <translation>不確かな道路縁</translation>
    </message>
    <message>
        <source>end of the survey</source>
        <translation>計測の終わり</translation>
    </message>
    <message>
        <source>not surveyed</source>
        <translation>未計測</translation>
    </message>
    <message>
        <source>no sidewalks</source>
        <translation>歩道部なし</translation>
    </message>
    <message>
        <source>no lanes</source>
        <translation>車線なし</translation>
    </message>
    <message>
        <source>no stop line</source>
        <translation>停止線なし</translation>
    </message>
    <message>
        <source>island not shown</source>
        <translation>島が不確か</translation>
    </message>
    <message>
        <source>island's height</source>
        <translation>島の高さ</translation>
    </message>
    <message>
        <source>junction not cut</source>
        <translation>交差部を区切れない</translation>
    </message>
    <message>
        <source>other edge not seen</source>
        <translation>反対側の縁が見えない</translation>
    </message>
    <message>
        <source>edge without a carriageway</source>
        <translation>車道のない縁</translation>
    </message>
    <message>
        <source>edge beside another</source>
        <translation>別の縁に並ぶ縁</translation>
    </message>
    <message>
        <source>tram track</source>
        <translation>軌道敷</translation>
    </message>
    <message>
        <source>road above a road</source>
        <translation>道路の立体交差</translation>
    </message>
    <message>
        <source>given roads moved</source>
        <translation>与えられた道路を移動</translation>
    </message>
    <message>
        <source>arm not cut</source>
        <translation>区切れない接続道路</translation>
    </message>
    <message>
        <source>junctions not parted</source>
        <translation>分けられない交差部</translation>
    </message>
    <message>
        <source>edge not closed</source>
        <translation>閉じない道路縁</translation>
    </message>
    <message>
        <source>sides contradict</source>
        <translation>道路側の矛盾</translation>
    </message>
    <message>
        <source>surface repaired</source>
        <translation>修正した面</translation>
    </message>
    <message>
        <source>white</source>
        <translation>白</translation>
    </message>
    <message>
        <source>yellow</source>
        <translation>黄</translation>
    </message>
    <message>
        <source>under 15 cm</source>
        <translation>15 cm 未満</translation>
    </message>
    <message>
        <source>15 cm and more</source>
        <translation>15 cm 以上</translation>
    </message>
    <message>
        <source>road, to look at</source>
        <translation>道路、要確認</translation>
    </message>
    <message>
        <source>junction, to look at</source>
        <translation>交差部、要確認</translation>
    </message>
    <message>
        <source>bridge, to look at</source>
        <translation>橋、要確認</translation>
    </message>
    <message>
        <source>tunnel, to look at</source>
        <translation>トンネル、要確認</translation>
    </message>
    <message>
        <source>lowest roofs</source>
        <translation>最も低い屋根</translation>
    </message>
    <message>
        <source>highest roofs</source>
        <translation>最も高い屋根</translation>
    </message>
    <message>
        <source>below 4 satellites: no position</source>
        <translation>衛星4個未満：測位不可</translation>
    </message>
    <message>
        <source>4 to 5 satellites</source>
        <translation>衛星4～5個</translation>
    </message>
    <message>
        <source>6 to 8 satellites</source>
        <translation>衛星6～8個</translation>
    </message>
    <message>
        <source>9 to 12 satellites</source>
        <translation>衛星9～12個</translation>
    </message>
    <message>
        <source>13 satellites and more</source>
        <translation>衛星13個以上</translation>
    </message>
    <message>
        <source>inside a building</source>
        <translation>建物内</translation>
    </message>
    <message>
        <source>in its place</source>
        <translation>正しい位置</translation>
    </message>
    <message>
        <source>moved to its points</source>
        <translation>点群に合わせて移動</translation>
    </message>
    <message>
        <source>place not observable</source>
        <translation>位置の観測不可</translation>
    </message>
    <message>
        <source>too few points</source>
        <translation>点不足</translation>
    </message>
    <message>
        <source>no points</source>
        <translation>点なし</translation>
    </message>
    <message>
        <source>pole, measured</source>
        <translation>柱（計測）</translation>
    </message>
    <message>
        <source>pole, doubtful</source>
        <translation>柱（不確実）</translation>
    </message>
    <message>
        <source>lamp post, measured</source>
        <translation>街灯（計測）</translation>
    </message>
    <message>
        <source>lamp post, doubtful</source>
        <translation>街灯（不確実）</translation>
    </message>
    <message>
        <source>signal, measured</source>
        <translation>信号（計測）</translation>
    </message>
    <message>
        <source>signal, doubtful</source>
        <translation>信号（不確実）</translation>
    </message>
    <message>
        <source>sign, measured</source>
        <translation>標識（計測）</translation>
    </message>
    <message>
        <source>sign, doubtful</source>
        <translation>標識（不確実）</translation>
    </message>
    <message>
        <source>tree, measured</source>
        <translation>樹木（計測）</translation>
    </message>
    <message>
        <source>tree, doubtful</source>
        <translation>樹木（不確実）</translation>
    </message>
    <message>
        <source>bollard, measured</source>
        <translation>車止め（計測）</translation>
    </message>
    <message>
        <source>bollard, doubtful</source>
        <translation>車止め（不確実）</translation>
    </message>
    <message>
        <source>other upright, measured</source>
        <translation>その他の立体物（計測）</translation>
    </message>
    <message>
        <source>other upright, doubtful</source>
        <translation>その他の立体物（不確実）</translation>
    </message>
    <message>
        <source>survey to outline</source>
        <translation>計測から外周線へ</translation>
    </message>
    <message>
        <source>empty</source>
        <translation>空</translation>
    </message>
    <message>
        <source>failed (see table)</source>
        <translation>失敗（表を参照）</translation>
    </message>
    <message>
        <source>same</source>
        <translation>変化なし</translation>
    </message>
    <message>
        <source>new</source>
        <translation>新築</translation>
    </message>
    <message>
        <source>gone</source>
        <translation>滅失</translation>
    </message>
    <message>
        <source>raised</source>
        <translation>高くなった</translation>
    </message>
    <message>
        <source>lowered</source>
        <translation>低くなった</translation>
    </message>
    <message>
        <source>rebuilt</source>
        <translation>建て替え</translation>
    </message>
    <message>
        <source>extended</source>
        <translation>増築</translation>
    </message>
    <message>
        <source>reduced</source>
        <translation>一部除却</translation>
    </message>
</context>
</TS>
